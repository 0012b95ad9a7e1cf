"""The formulas of Stronge (1994) as printed, errors included; for checking only.

One function an equation, named by its number; formulas without a number bear their page. They
follow the sections of the paper: `dynamics` (Eqs 1 to 9, Table 1), `slip` (Eqs 10 to 27),
`peak_force` (Eqs 28 to 35), `dissipation` (Eqs 36 to 41). `impact` puts them together as the
paper does, from incidence to rebound. What is wrong in them, and what is right instead, stands in
data/stronge1994/ledger.yaml; `stronge1994.ledger` measures it. To solve anything, use
`planarimpact.lumped`.

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
