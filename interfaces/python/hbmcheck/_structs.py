"""The structs of hbmcheck.h, field by field in its order; tests/python holds sizes and offsets against the C compiler's."""
from ctypes import CFUNCTYPE, Structure, c_char_p, c_double, c_int, c_size_t, c_void_p, sizeof

TICK = CFUNCTYPE(c_int, c_void_p, c_double)
TEXT, INTEGER, REAL, SERIES = range(4)  # hbmcheck_kind


class Monitor(Structure):
    _fields_ = [("size", c_size_t), ("tick", TICK), ("self", c_void_p)]


class Column(Structure):
    _fields_ = [("size", c_size_t), ("kind", c_int), ("name", c_char_p), ("unit", c_char_p), ("meaning", c_char_p)]


def sized(kind, *fields):
    """One of these, its size told."""
    return kind(sizeof(kind), *fields)
