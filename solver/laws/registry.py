"""Which laws there are, and how a kernel chooses among them: by the class of the parameters, when it is compiled."""

from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

from solver._jit import chosen_by_type, inlined
from solver.softening import NO_SOFTENING, Softening

NO_CUTOFF = 1e30  # Pa, tension that no ground bears


class Law(Protocol):
    """Parameters of a law; the others differ from law to law."""

    @property
    def bulk_modulus(self) -> float:
        """In Pa."""

    @property
    def shear_modulus(self) -> float:
        """In Pa."""

    @property
    def softening(self) -> Softening:
        """How its strength falls."""

    @property
    def _replace(self) -> Callable[..., Any]:
        """Makes another one, with some parameters changed; every law is a ``NamedTuple``."""


class Constants(NamedTuple):
    """Engineering constants that every law is made from; each takes those it needs."""

    young_modulus: float  # Pa
    poisson_ratio: float
    dilation_angle: float  # rad
    softening: Softening
    tension_cutoff: float = NO_CUTOFF  # Pa


_MAKERS: dict[str, Callable[[Constants], Law]] = {}
_POINT_LAWS: dict[type, Callable[..., Any]] = {}


def constitutive_law(name: str, parameters: type, make: Callable[[Constants], Any]) -> Callable[[Any], Any]:
    """Enter the decorated point function, of the arguments of ``update_stress``, as that of a law.

    Parameters
    ----------
    name : str
        The law's name in a scene.
    parameters : type
        A ``NamedTuple``; the first argument of the point function is one of these.
    make : callable
        Makes one from ``Constants``.
    """

    def enter(function: Any) -> Any:
        _MAKERS[name] = make
        _POINT_LAWS[parameters] = inlined(function)
        return function

    return enter


def unyielding(law: Law) -> Law:
    """Return the law of ground whose particles have more strength than they need: it neither softens nor cracks."""
    kept: Law = law._replace(softening=NO_SOFTENING)
    if hasattr(kept, "tension_cutoff"):
        kept = kept._replace(tension_cutoff=NO_CUTOFF)
    return kept


def law_names() -> list[str]:
    """Return the names of all laws."""
    return sorted(_MAKERS)


def make_law(name: str, constants: Constants) -> Law:
    """Return the parameters of the law of that name."""
    return _MAKERS[name](constants)


def update_stress(law, stress, strain, plastic_strain, strength, dt):
    """Return ``(xx, yy, zz, xy, plastic_strain)`` of one point after a strain increment, tension positive.

    Parameters
    ----------
    law : NamedTuple
        Parameters of a law; their class chooses it.
    stress : tuple of 4 float
        xx, yy, zz, xy in Pa, already turned with the ground.
    strain : tuple of 3 float
        Increment xx, yy, xy (tensor shear); zz is 0.
    plastic_strain : float
        Accumulated equivalent deviatoric plastic strain.
    strength : solver.softening.Strength
    dt : float
        Length of the increment in s.
    """
    return _POINT_LAWS[type(law)](law, stress, strain, plastic_strain, strength, dt)


@chosen_by_type(update_stress)
def _point_law(law, stress, strain, plastic_strain, strength, dt):
    return _POINT_LAWS[law.instance_class]
