"""The formulas of Stronge (1994) as printed, errors included; for checking only.

One function an equation, named by its number; formulas without a number bear their page. Here are
those that figures draw: `impact` puts them together as the paper does, from incidence to rebound.
The others stand in `stronge1994.paper`, each beside the entry that says what is wrong in it, and
what is right instead. To solve anything, use `planarimpact.lumped`.

Symbols, in any consistent units:

====================  ===========================================================================
v1, v2                velocities of the contact point at t = 0, tangential and normal; both < 0
v1_t2, u1_t2, ...     tangential velocity and deflection of the particle at an instant t2
m1, m2                effective masses, of Eq. 2
stiffness             kappa of the normal element in compression; kappa/zeta^2 the tangential one
stiffness_ratio       zeta^2
normal_frequency      Omega; tangential_frequency is omega
friction              mu
restitution           e, the energetic coefficient
slip_direction        s = sgn(v1 + du1/dt), +1 or -1; friction is F1 = -mu s F2
incidence             v1(0)/(mu v2(0)), positive
====================  ===========================================================================

While the contact sticks du1/dt = -v1. Arrays broadcast. Arguments are not checked, and no range is
enforced: a range is part of what the ledger tests. `impact` alone selects by the printed ranges.
"""
