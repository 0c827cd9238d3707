"""Functions that compiled loops call and Numba's own runtime has, in LLVM's language.

With them the loop's code calls nothing but the C library's memory.
"""

ARITHMETIC = """
declare double @llvm.sqrt.f64(double)
define double @sqrt(double %x) alwaysinline nounwind {
  %root = call double @llvm.sqrt.f64(double %x)
  ret double %root
}
define double @numba_frexp(double %x, ptr %exponent) nounwind {
  %bits = bitcast double %x to i64
  %shifted = lshr i64 %bits, 52
  %field = and i64 %shifted, 2047
  %power = sub i64 %field, 1022
  %short = trunc i64 %power to i32
  store i32 %short, ptr %exponent
  %fraction = and i64 %bits, 4503599627370495
  %half = or i64 %fraction, 4602678819172646912
  %mantissa = bitcast i64 %half to double
  ret double %mantissa
}
"""
"""Roots are the processor's own, and numbers whose exponent is asked for are positive and normal:
the same bits everywhere."""

MEMORY = """
%header = type { i64, ptr, ptr, ptr, i64 }
declare ptr @malloc(i64) nounwind
declare void @free(ptr) nounwind
define ptr @NRT_MemInfo_alloc_aligned(i64 %size, i32 %alignment) nounwind {
  %along = zext i32 %alignment to i64
  %wanted = add i64 %size, %along
  %all = add i64 %wanted, 40
  %block = call ptr @malloc(i64 %all)
  %none = icmp eq ptr %block, null
  br i1 %none, label %end, label %fill
fill:
  %address = ptrtoint ptr %block to i64
  %behind = add i64 %address, 40
  %beyond = add i64 %behind, %along
  %last = sub i64 %beyond, 1
  %over = sub i64 0, %along
  %aligned = and i64 %last, %over
  %data = inttoptr i64 %aligned to ptr
  store i64 1, ptr %block
  %place = getelementptr %header, ptr %block, i32 0, i32 3
  store ptr %data, ptr %place
  br label %end
end:
  ret ptr %block
}
define void @NRT_MemInfo_call_dtor(ptr %block) nounwind {
  call void @free(ptr %block)
  ret void
}
"""
"""Room for an array that a function makes: a header, whose first word counts references and whose
fourth is where the array is, and the array; given back when nobody refers to it."""
