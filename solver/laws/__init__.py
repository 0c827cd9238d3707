"""Laws of force: contact and friction in joints with play, and elements between points.

Each family is a folder, whose registry its `__init__` is, and each member one file: a model whose
fields are the law's parameters in a scene. Its methods take abstract scalars, and its fields are
such, too, where a kernel is compiled (`mechanics.view`); rules and properties see plain numbers.
"""
