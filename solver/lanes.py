"""Eight numbers at once: a vector type for kernels, and functions that take a number or eight alike.

LLVM vectorises a loop only if it can prove that nothing stands in the way, which it seldom can of a transfer between
particles and nodes. ``Lanes`` are a vector in the first place. Arithmetic, comparison (to a ``Mask``), ``min``,
``max``, ``abs`` and ``math.sqrt`` work lane by lane, and LLVM cuts them to what there is (AVX-512, AVX2, NEON).

A function of one point that is written with these, with ``where`` for a choice, and with ``&`` and ``|`` for logic,
runs on floats in plain Python, on floats in a kernel, and on lanes: the same lines, the same results. A branch may only
skip work: ``if anywhere(condition): value = where(condition, other, value)``.
"""

import math
import operator
from typing import Any

from llvmlite import ir
from numba import extending
from numba.core import cgutils, types
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import lower_builtin, models, register_model

from solver._jit import FAST_MATH, chosen_by_type
from solver.constants import LANE_COUNT

intrinsic: Any = extending.intrinsic  # a kernel gives the first argument of what it decorates

_VECTOR = ir.VectorType(ir.DoubleType(), LANE_COUNT)
_BITS = ir.VectorType(ir.IntType(1), LANE_COUNT)
_PLACES = ir.VectorType(ir.IntType(32), LANE_COUNT)
_FLAGS = tuple(sorted(FAST_MATH))


class Lanes(types.Type):
    """Eight floats."""

    def __init__(self) -> None:
        super().__init__(name=f"Lanes{LANE_COUNT}")


class Mask(types.Type):
    """Eight truth values."""

    def __init__(self) -> None:
        super().__init__(name=f"Mask{LANE_COUNT}")


LANES, MASK, FLOAT = Lanes(), Mask(), types.float64


@register_model(Lanes)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, _VECTOR)


@register_model(Mask)
class _MaskModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, _BITS)


def _shuffle(builder: Any, a: Any, b: Any, places: list[int]) -> Any:
    return builder.shuffle_vector(a, b, ir.Constant(_PLACES, places))


def _lifted(builder: Any, kind: Any, value: Any) -> Any:
    """Return the value as a vector: a float goes to every lane."""
    if isinstance(kind, Lanes):
        return value
    undefined = ir.Constant(_VECTOR, ir.Undefined)
    first = builder.insert_element(undefined, value, ir.Constant(ir.IntType(32), 0))
    return _shuffle(builder, first, undefined, [0] * LANE_COUNT)


def _declare(function: Any, signatures: list[Any]) -> None:
    """Let Numba's type inference know a Python operator or function on vectors."""
    infer_global(function)(type("Signatures", (ConcreteTemplate,), {"cases": signatures}))


def _register(function: Any, result: Any, kinds: tuple[tuple[Any, ...], ...], emit: Any) -> None:
    """Let kernels call a Python operator or function on vectors."""
    _declare(function, [signature(result, *kind) for kind in kinds])

    def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return emit(builder, *(_lifted(builder, kind, value) for kind, value in zip(sig.args, args, strict=True)))

    for kind in kinds:
        lower_builtin(function, *kind)(lower)


def _llvm(name: str) -> Any:
    """Return what calls the LLVM function ``name`` of one vector."""

    def emit(builder: Any, a: Any) -> Any:
        kind = ir.FunctionType(_VECTOR, [_VECTOR])
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.v{LANE_COUNT}f64"), [a])

    return emit


def _arithmetic(name: str) -> Any:
    return lambda builder, a, b: getattr(builder, name)(a, b, flags=_FLAGS)


def _compared(sign: str) -> Any:
    return lambda builder, a, b: builder.fcmp_ordered(sign, a, b)


def _chosen(sign: str) -> Any:
    """Return what takes the second of two numbers where it compares, else the first: that, too, where one is NaN."""
    return lambda builder, a, b: builder.select(builder.fcmp_ordered(sign, b, a), b, a)


_ONE, _TWO = ((LANES,),), ((LANES, LANES), (LANES, FLOAT), (FLOAT, LANES))
for _name, *_functions in (
    ("fadd", operator.add, operator.iadd),
    ("fsub", operator.sub, operator.isub),
    ("fmul", operator.mul, operator.imul),
    ("fdiv", operator.truediv, operator.itruediv),
):
    for _function in _functions:
        _register(_function, LANES, _TWO, _arithmetic(_name))
for _sign, _function in (
    ("<", operator.lt),
    (">", operator.gt),
    ("<=", operator.le),
    (">=", operator.ge),
    ("==", operator.eq),
):
    _register(_function, MASK, _TWO, _compared(_sign))
_register(max, LANES, _TWO, _chosen(">"))
_register(min, LANES, _TWO, _chosen("<"))
_register(operator.neg, LANES, _ONE, lambda builder, a: builder.fsub(ir.Constant(_VECTOR, [-0.0] * LANE_COUNT), a))
_register(abs, LANES, _ONE, _llvm("fabs"))
_register(math.sqrt, LANES, _ONE, _llvm("sqrt"))


def _register_logic(function: Any, emit: Any) -> None:
    _declare(function, [signature(MASK, MASK, MASK)])
    lower_builtin(function, MASK, MASK)(lambda context, builder, sig, args: emit(builder, *args))


_register_logic(operator.and_, lambda builder, a, b: builder.and_(a, b))
_register_logic(operator.or_, lambda builder, a, b: builder.or_(a, b))


@intrinsic
def _select(typing_context: Any, condition: Any, a: Any, b: Any) -> Any:
    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return builder.select(args[0], _lifted(builder, sig.args[1], args[1]), _lifted(builder, sig.args[2], args[2]))

    kinds = (kind if isinstance(kind, Lanes) else FLOAT for kind in (a, b))
    return LANES(MASK, *kinds), emit


def where(condition: Any, a: Any, b: Any) -> Any:
    """Return ``a`` where the condition holds and ``b`` elsewhere; of floats, or lane by lane."""
    return a if condition else b


@chosen_by_type(where)
def _where(condition: Any, a: Any, b: Any) -> Any:
    if isinstance(condition, Mask):
        return lambda condition, a, b: _select(condition, a, b)
    return lambda condition, a, b: a if condition else b


@intrinsic
def bits(typing_context: Any, mask: Any) -> Any:
    """Return the lanes of a mask as the bits of an integer, lane 0 the lowest."""

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return builder.zext(builder.bitcast(args[0], ir.IntType(LANE_COUNT)), ir.IntType(64))

    return types.int64(MASK), emit


def anywhere(condition: Any) -> Any:
    """Return whether a condition holds, of a float or of any lane."""
    return condition


@chosen_by_type(anywhere)
def _anywhere(condition: Any) -> Any:
    if isinstance(condition, Mask):
        return lambda condition: bits(condition) != 0
    return lambda condition: condition


@intrinsic
def splat(typing_context: Any, value: Any) -> Any:
    """Return lanes that all have the value."""
    return LANES(FLOAT), lambda context, builder, sig, args: _lifted(builder, FLOAT, args[0])


@intrinsic
def lane_numbers(typing_context: Any) -> Any:
    """Return 0, 1, ... 7."""
    return LANES(), lambda context, builder, sig, args: ir.Constant(_VECTOR, [float(i) for i in range(LANE_COUNT)])


@intrinsic
def total(typing_context: Any, a: Any) -> Any:
    """Return the sum of the lanes."""

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        kind = ir.FunctionType(ir.DoubleType(), [ir.DoubleType(), _VECTOR])
        name = f"llvm.vector.reduce.fadd.v{LANE_COUNT}f64"
        function = cgutils.get_or_insert_function(builder.module, kind, name)
        return builder.call(function, [ir.Constant(ir.DoubleType(), 0.0), args[0]], fastmath=_FLAGS)

    return FLOAT(LANES), emit


def _pointer(context: Any, builder: Any, kind: Any, array: Any, start: Any) -> Any:
    return builder.gep(context.make_array(kind)(context, builder, array).data, [start])


@intrinsic
def load(typing_context: Any, array: Any, start: Any) -> Any:
    """Return eight entries of a contiguous array of any shape, from the flat index ``start`` on."""

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        pointer = builder.bitcast(_pointer(context, builder, sig.args[0], *args), _VECTOR.as_pointer())
        return builder.load(pointer, align=8, typ=_VECTOR)

    return LANES(array, types.int64), emit


@intrinsic
def store(typing_context: Any, array: Any, start: Any, value: Any) -> Any:
    """Set eight entries of a contiguous array of any shape, from the flat index ``start`` on."""

    def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        value = _lifted(builder, sig.args[2], args[2])
        pointer = builder.bitcast(_pointer(context, builder, sig.args[0], *args[:2]), _VECTOR.as_pointer())
        builder.store(value, pointer, align=8)
        return context.get_dummy_value()

    return types.void(array, types.int64, value if isinstance(value, Lanes) else FLOAT), emit


def _shift(count: int, keeps: bool) -> Any:
    lanes = range(LANE_COUNT)
    kept = [i - count if i >= count else LANE_COUNT for i in lanes]
    spilled = [LANE_COUNT - count + i if i < count else LANE_COUNT for i in lanes]

    @intrinsic
    def shift(typing_context: Any, a: Any) -> Any:
        def emit(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            nothing = ir.Constant(_VECTOR, [0.0] * LANE_COUNT)
            return _shuffle(builder, args[0], nothing, kept if keeps else spilled)

        return LANES(LANES), emit

    return shift


# Lanes moved up by one or two places: what stays in the vector, and what spills to the next eight.
up_1, up_2 = _shift(1, keeps=True), _shift(2, keeps=True)
spill_1, spill_2 = _shift(1, keeps=False), _shift(2, keeps=False)
