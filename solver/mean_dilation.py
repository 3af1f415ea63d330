"""One change of volume for all particles of a cell, against volumetric locking.

Soil that yields without dilation keeps its volume. uGIMP asks that of every particle, more often than the nodes have
freedom to move, and the ground grows too strong: limit loads have no plateau. As in the B-bar element (Nagtegaal, Parks
and Rice 1974, CMAME 4:153; Hughes 1980, IJNME 15:1413) the dilation of a particle gives way to the mean of its cell:

    theta_p = L_xx + L_yy,   Lbar_p = L_p + 1/2 (A theta - theta)_p 1

``A`` pools in cells and reads back (``cells``). Only the in-plane strain changes: plane strain stays plane. The
internal force follows from virtual work. With the in-plane mean stress ``P = (s_xx + s_yy) / 2``

    sum_p V_p s_p : Lbar_p = sum_p V_p (s_p : L_p + P_p (A theta - theta)_p) = sum_p V_p (s_p + (A P - P)_p 1) : L_p

because ``sum_p V_p P_p (A theta)_p = sum_c (sum_p w V P)(sum_p w V theta) / sum_p w V`` is symmetric in ``P`` and
``theta``. So the force takes the cell mean of ``P`` (not of the mean of three stresses), and the work ``s_p : Lbar_p``
of the stresses is the work that the nodes see. With the particles' own ``P`` in the force a slide gains a third of the
energy that gravity gives it.
"""

from solver._jit import inlined

NO_VOLUME = 1e-12  # m2: an empty cell


@inlined
def with_mean_dilation(increment, mean):
    """Return displacement gradients ``(xx, xy, yx, yy)`` with the dilation ``mean`` of their cells."""
    xx, xy, yx, yy = increment
    correction = 0.5 * (mean - xx - yy)
    return xx + correction, xy, yx, yy + correction
