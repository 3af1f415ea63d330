"""The softening rate in terms of a laboratory: how far a shear band slips until its strength is residual.

Slip ``u`` across a band of thickness ``t`` is an engineering shear strain ``u / t``. Without dilation its plastic part
is pure shear with the tensor component ``u / 2 t``, and the equivalent deviatoric strain ``sqrt(2/3 e : e)``, which
softens, is

    eps_p = u / (sqrt(3) t).

Of the drop from peak to residual strength ``exp(-rate eps_p)`` is left, or ``1 - rate eps_p``. The *slip to residual*
is that after which 5 % is left, as no exponential ends, or nothing where softening is linear:

    rate u = sqrt(3) t ln 20    or    rate u = sqrt(3) t.

With an internal length ``l`` slip weakens a band as if ``t = l`` (``nonlocal_softening``), on all cells.
"""

import math

SHARE_LEFT = 0.05  # of the drop from peak to residual, at the end of exponential softening


def rate_of(slip: float, thickness: float, is_linear: bool) -> float:
    """Return the rate, per unit plastic strain, at which ``slip`` (m) makes a band of ``thickness`` (m) residual."""
    return _rate_times_slip(thickness, is_linear) / slip


def slip_of(rate: float, thickness: float, is_linear: bool) -> float:
    """Return the slip in m that makes a band of ``thickness`` (m) residual at a rate per unit plastic strain."""
    return _rate_times_slip(thickness, is_linear) / rate


def _rate_times_slip(thickness: float, is_linear: bool) -> float:
    return math.sqrt(3.0) * thickness * (1.0 if is_linear else -math.log(SHARE_LEFT))
