"""Linear algebra for starts and studies: small matrices, the same bits on every processor.

LAPACK and BLAS add in another order on another processor. Here every sum has one order, and every
operation is one that processors round alike; the last axes are those of a matrix.
"""
