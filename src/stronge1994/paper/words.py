"""Words that many entries share: symbols, and what went wrong in the paper."""

# Parts are divided by semicolons, and each begins with what it explains.
SYMBOLS = (
    "$t$: time, 0 at first contact; $v_1$, $v_2$: tangential and normal velocity of the contact "
    "point, both negative at $t = 0$; $u_1$, $u_2$: deflections of the tangential and of the "
    "normal element; $F_1$, $F_2$: tangential and normal force, $F_1$ being friction; "
    r"$F_{1\mathrm{max}}$, $F_{2\mathrm{max}}$: largest tangential and normal force; $p(t)$: "
    "normal impulse up to $t$; $s$: direction of slip, +1 or $-1$, $-1$ being that of incidence; "
    "$m_1$, $m_2$: effective masses; $M$: mass of the body; $k$: radius of gyration of the body; "
    r"$x_1$, $x_2$: place of the contact point from the centre of mass; $\phi'$: spin; $\kappa$: "
    r"normal stiffness; $\zeta^2$: normal over tangential stiffness; $\Omega$, $\omega$: normal "
    r"and tangential frequency; $e$: coefficient of restitution; $\mu$: coefficient of friction; "
    r"$S$: speed of incidence; $\theta$: angle of incidence from the normal; $x = v_1(0)/(\mu "
    r"v_2(0))$: incidence, with $\tan(\theta) = \mu x$; $\beta = m_2/m_1$: ratio of the effective "
    "masses; $t_c$: end of compression; $t_f$: separation; $t_1$: start of slip after initial "
    "stick; $t_2$: start of the stick after a first slip; $t_3$: start of the slip after that "
    r"stick; $t_s$: end of slip without tangential compliance; $\alpha = \Omega t/e + (\pi/2)(1 - "
    r"1/e)$: angle of restitution, which rises from $\pi/2$ at $t_c$ to $\pi$ at $t_f$; $g_1$: "
    "normal impulse after $t_1$ over $p(t_c)$; $D_1$, $D_2$: energy lost to friction and in the "
    r"normal element; $K_0$: kinetic energy at first; $\nu$: Poisson's ratio; $\psi_1 = "
    r"x/\zeta^2$, $\chi = \beta/(2 \zeta^2)$: variables of Maw et al."
)

# What went wrong, once for all entries that follow from it.
CAUSES = {
    "slip-limit": (
        "The paper puts the limit of slip throughout at $(1 + e) m_2/m_1$, the incidence at which "
        "the body would stop. Slip ends where the particle stops, and in restitution the "
        "unloading spring drives the particle ahead of the body."
    ),
    "last-slip-direction": (
        "The paper lets the last slip run against the first, whatever $e$ is. If restitution is "
        "short, the last slip can run in the incident direction."
    ),
    "strain-energy": (
        "The paper takes the work of friction on the body, with $v_1$, over the times of slip. "
        "Friction acts on the particle, so the tangential strain energy at the start and the end "
        "of each slip is left out."
    ),
    "place-of-most-dissipation": (
        "The paper places the largest dissipation just above the limit of slip throughout. How "
        "near the two are depends on friction."
    ),
    "peak-angle": ("One angle that the paper states is not the one that its equations give."),
    "late-stick": (
        "The paper lets the stick after the first slip begin in compression at all intermediate "
        "incidences. Above $m_2/m_1$ it begins in restitution, as Eq. 21 says. One heading of p. "
        "445 causes all of these entries: with $m_2/m_1$ in place of $(1 + e) m_2/m_1$, which a "
        "parenthesis on p. 447 has, they would be right."
    ),
    "sign-of-deflection": (
        "The deflection $u_1$ has one sign in Eq. 7c, and the other in Eq. 31 and in a sentence "
        "of p. 441. In Eqs 18, 23 and 32 the scan leaves the sign open."
    ),
    "slips-of-the-pen": "One digit or one word is not what the equations around it ask for.",
    "lumped-and-continuum": (
        "The paper says in words, without a number, how alike its lumped model and the continuum "
        "are."
    ),
    "more-than-three-phases": (
        r"The paper does not consider phases after the second slip. They exist only where $\omega$ "
        r"is well above $\Omega$."
    ),
    "cited-annulus": (
        "Under a constant normal force an outer annulus slips. The paper carries this over to an "
        "impact, where the normal force grows."
    ),
    "restitution-swing": (
        "The paper takes the velocity that is gained in restitution to fall with $e$, as the "
        "normal impulse does. The tangential spring swings on at its own pace."
    ),
}
