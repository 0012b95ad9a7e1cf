/*
 * spheres.h: the rebound of rough spheres after an oblique impact, every impact with materials of
 * its own.
 *
 * <version>
 * A template: the package replaces what stands between two marks, the prefix of all names, and the
 * name of this file. The table here only has the form of one.
 * </version>
 *
 * Model: the contact of Hertz with micro-slip (the continuum), with what takes the energy where
 * restitution is below 1, one for each impact:
 *   SPHERES_VISCOUS: Kelvin-Voigt spheres with one relaxation time
 *   SPHERES_PLASTIC: elastic-plastic spheres, which flow in shear while they yield
 *
 * Functions of the incidence x = v1(0)/(mu v2(0)), of any sign, and of
 *   mass_ratio: m2/m1, effective normal over tangential mass: 3.5 for solid spheres, 2.5 for thin
 *   shells
 *   stiffness_ratio: zeta^2, normal over tangential stiffness: (2 - nu)/(2 (1 - nu)), nu of
 *   Poisson
 *   restitution: e, the energetic coefficient
 *   loss: SPHERES_VISCOUS or SPHERES_PLASTIC
 * are
 *   spheres_covers(x, mass_ratio, stiffness_ratio, restitution, loss), whether there is an answer;
 *   spheres_velocity(x, mass_ratio, stiffness_ratio, restitution, loss), the velocity alone;
 *   spheres_rebound(x, mass_ratio, stiffness_ratio, restitution, loss), which has
 *     velocity: v1(tf)/(mu v2(0)), which has the sign opposite to x where the contact point has
 *       turned round
 *     peak_friction: largest friction, over mu times the largest normal force
 *     dissipation: work of friction, in mu^2 m2 v2(0)^2; with plastic loss also that of the flow
 *     in shear
 *     regime: the order of stick and slip, one of the codes below
 *
 * Units and signs: v1 and v2 are the tangential and the normal velocity of the contact point,
 * before the impact (0) and after it (tf), both in one unit. v2(0) is positive towards the
 * surface. mu is the coefficient of friction, above 0.
 *
 * Range: |x| up to SPHERES_INCIDENCE_MAX, restitution from SPHERES_RESTITUTION_MIN to 1,
 * mass_ratio from 1, stiffness_ratio up to SPHERES_STIFFNESS_MAX, mass_ratio/stiffness_ratio from
 * SPHERES_RATIO_MIN to SPHERES_RATIO_MAX. Beyond it, and for NaN, the numbers are NaN and the
 * regime is SPHERES_UNRESOLVED.
 *
 * Error against the model, of velocity, peak_friction and dissipation: at most
 * SPHERES_ERROR_VISCOUS or SPHERES_ERROR_PLASTIC, by loss. It was measured by a search for the
 * largest error; it is not proved. Slip throughout is a line.
 *
 * Example:
 *   #include "spheres.h"
 *
 *   double v1 = 6.0, v2 = 5.0, mu = 0.8, e = 0.9; // a solid sphere of rubber, before the impact
 *   double v1_after = mu * v2 * spheres_velocity(v1 / (mu * v2), 3.5, 1.5, e, SPHERES_VISCOUS);
 *   double v2_after = -e * v2;
 */

#ifndef PLANARIMPACT_SPHERES_H
#define PLANARIMPACT_SPHERES_H

/* A compiler without NaN may drop the test of the range, and a table is read beyond its ends. GCC
   and Clang always define the first of these names, MSVC defines the last with /fp:fast. */
#if defined(__FINITE_MATH_ONLY__) ? __FINITE_MATH_ONLY__ : defined(__FAST_MATH__)
#error "This header needs NaN: add -fno-finite-math-only after -ffast-math"
#elif defined(_M_FP_FAST)
#error "This header needs NaN: compile it without /fp:fast"
#endif

#include <math.h>

/* <public> */
#define SPHERES_VISCOUS 0
#define SPHERES_PLASTIC 1
#define SPHERES_INCIDENCE_MAX 8e+307
#define SPHERES_RESTITUTION_MIN 0.3
#define SPHERES_STIFFNESS_MAX 1.6
#define SPHERES_RATIO_MIN 1.5625
#define SPHERES_RATIO_MAX 3.5
#define SPHERES_ERROR_VISCOUS 0.003
#define SPHERES_ERROR_PLASTIC 0.04
#define SPHERES_STICK 0
#define SPHERES_SLIP_STICK 1
#define SPHERES_STICK_SLIP 2
#define SPHERES_SLIP_STICK_SLIP 3
#define SPHERES_SLIP_THROUGHOUT 4
#define SPHERES_MULTIPLE 5
#define SPHERES_UNRESOLVED 6
/* </public> */

/*
 * Numbers of the functions below.
 *   B_LEAST, B_SPAN, E_LEAST, E_SPAN: ranges of b and restitution that u and t stand for
 *   UNIT: of the values
 *   MASS_RATIO_MOST, STIFFNESS_MOST, RATIO_LEAST, RATIO_MOST: bounds, which leave room for rounding
 *   NEARLY: a little less than 1: an impact so near to slip throughout slides throughout
 *   LEFT, RIGHT: where s has its root
 *   INTERVALS: intervals of limits over u
 */
/* <private> */
#define SPHERES_B_LEAST 1.55
#define SPHERES_B_SPAN 2.0
#define SPHERES_E_LEAST 0.295
#define SPHERES_E_SPAN 0.705
#define SPHERES_UNIT 0.000244140625
#define SPHERES_MASS_RATIO_MOST 8e+307
#define SPHERES_STIFFNESS_MOST 1.6000000016
#define SPHERES_RATIO_LEAST 1.5625
#define SPHERES_RATIO_MOST 3.5
#define SPHERES_NEARLY 0.9999999999999991
#define SPHERES_LEFT 1
#define SPHERES_RIGHT 2
#define SPHERES_INTERVALS 1
/* </private> */

/*
 * The table. A loss, or a part of it, is a panel; a panel has patches. In a patch velocity, peak
 * friction and work are cubic splines in s, t and u: places over y = x/stiffness_ratio,
 * restitution and b = mass_ratio/stiffness_ratio.
 *   limits: restitutions between the three plastic panels, over u
 *   panels: its first patch, and how many; edges that vary, their intervals over t and u;
 *   coefficients over t and u; where its edges and splines begin in values, or -1
 *   patches: where s has its root (0 nowhere, SPHERES_LEFT left, SPHERES_RIGHT right), intervals
 *   over s, and the first coefficient over s
 *   values: edges in y, and coefficients of splines, in units of SPHERES_UNIT
 */

static const double spheres_limits[] = {
/* <limits> */
0.7,0.5,0.8,0.6,
/* </limits> */
};

struct spheres_panel {
    int patch, patches, varying, rows, columns, over_t, over_u, edges, velocity, peak, work;
};
static const struct spheres_panel spheres_panels[] = {
/* <panels> */
{0,4,0,1,1,4,4,-1,0,0,0},
{0,4,0,1,1,4,4,-1,0,0,0},
{0,4,0,1,1,4,4,-1,0,0,0},
{0,4,0,1,1,4,4,-1,0,0,0},
/* </panels> */
};

static const int spheres_patches[] = {
/* <patches> */
0,1,0,1,1,4,
0,1,8,2,1,12,
/* </patches> */
};

static const int spheres_values[] = {
/* <values> */
0,0,0,0,0,0,
/* </values> */
};

struct spheres_result {
    double velocity;
    double peak_friction;
    double dissipation;
    int regime;
};

/* Where an impact is: what the splines need, and what follows from its edges. */
struct spheres_spot {
    const struct spheres_panel *panel;
    int base, slides;
    double over_s[4], over_t[4], over_u[4];
};

/* Which of so many intervals a value from 0 to so many is in. */
static inline int spheres_index(double at, int count)
{
    int index = (int)at;
    return index < count ? index : count - 1;
}

static inline double spheres_clipped(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* The interval that a value from 0 to 1 is in, and the four B-splines there. */
static inline int spheres_place(double value, int count, double *weights)
{
    double at = value * count;
    int index = spheres_index(at, count);
    double x = at - index, left = 1 - x;
    weights[0] = left * left * left / 6;
    weights[1] = (x * x * (x - 2) * 3 + 4) / 6;
    weights[2] = (left * left * (left - 2) * 3 + 4) / 6;
    weights[3] = x * x * x / 6;
    return index;
}

/* A spline, whose coefficients begin at a number of the values. */
static inline double spheres_spline(const struct spheres_spot *spot, int begin)
{
    const int *first = spheres_values + begin + spot->base;
    double outer = 0;
    int i, j, k;
    for (i = 0; i < 4; ++i) {
        double middle = 0;
        for (j = 0; j < 4; ++j) {
            const int *c = first + (i * spot->panel->over_t + j) * spot->panel->over_u;
            double inner = 0;
            for (k = 0; k < 4; ++k)
                inner += c[k] * spot->over_u[k];
            middle += inner * spot->over_t[j];
        }
        outer += middle * spot->over_s[i];
    }
    return outer * SPHERES_UNIT;
}

static inline struct spheres_spot spheres_find(double y, double b, double e, int loss)
{
    const double least = SPHERES_E_LEAST, unit = SPHERES_UNIT;
    double u = (b - SPHERES_B_LEAST) / SPHERES_B_SPAN, at = u * SPHERES_INTERVALS, t, over, across;
    double edge[6] = {0}, varying[2] = {0}, low, high, width, s, alike = b + e * (b - 1);
    const double *limit = spheres_limits + spheres_index(at, SPHERES_INTERVALS);
    const double *above = limit + SPHERES_INTERVALS + 1;
    double part = at - spheres_index(at, SPHERES_INTERVALS);
    double low_e = (1 - part) * limit[0] + part * limit[1];
    double high_e = (1 - part) * above[0] + part * above[1];
    int which = loss == SPHERES_VISCOUS ? 0 : e < low_e ? 1 : e < high_e ? 2 : 3, i, j, k;
    const struct spheres_panel *panel = spheres_panels + which;
    const int *patch;
    struct spheres_spot spot;
    if (which == 0)
        t = (e - least) / SPHERES_E_SPAN;
    else if (which == 1)
        t = 1 - sqrt(spheres_clipped(least / e - least / low_e, 0, 1) / (1 - least / low_e));
    else if (which == 2)
        t = (e - low_e) / (high_e - low_e);
    else
        t = sqrt(sqrt((1 - e) / (1 - high_e)));

    /* Edges, between four nodes. */
    at = t * panel->rows;
    i = spheres_index(at, panel->rows);
    over = at - i;
    at = u * panel->columns;
    j = spheres_index(at, panel->columns);
    across = at - j;
    for (k = 0; k < panel->varying; ++k) {
        int columns = panel->columns + 1;
        const int *c = spheres_values + panel->edges + (k * (panel->rows + 1) + i) * columns + j;
        double before = (1 - across) * (c[0] * unit) + across * (c[1] * unit);
        double after = (1 - across) * (c[columns] * unit) + across * (c[columns + 1] * unit);
        varying[k] = (1 - over) * before + over * after;
    }
    edge[1] = 1;
    if (which == 0) {
        edge[2] = varying[0];
        edge[3] = varying[1] < b ? varying[1] : b;
        edge[4] = b;
        edge[5] = alike;
    } else {
        edge[3] = which == 3 ? b : varying[0];
        edge[2] = (1 + edge[3]) / 2;
        edge[4] = which == 1 ? varying[1] : alike;
    }

    /* The patch, and s in it. */
    which = panel->patch;
    low = edge[0];
    high = edge[1];
    for (k = 1; k < panel->patches; ++k) {
        if (y >= edge[k]) {
            ++which;
            low = edge[k];
            high = edge[k + 1];
        }
    }
    width = high - low;
    s = spheres_clipped((y - low) / (width > 0 ? width : 1), 0, 1);
    patch = spheres_patches + 3 * which;
    if (patch[0] == SPHERES_RIGHT)
        s = 1 - sqrt(1 - s);
    else if (patch[0] == SPHERES_LEFT)
        s = sqrt(s);

    spot.panel = panel;
    spot.slides = y >= edge[panel->patches] * SPHERES_NEARLY;
    spot.base = patch[2] + spheres_place(s, patch[1], spot.over_s);
    spot.base = spot.base * panel->over_t + spheres_place(t, panel->over_t - 3, spot.over_t);
    spot.base = spot.base * panel->over_u + spheres_place(u, panel->over_u - 3, spot.over_u);
    return spot;
}

/* Whether the table has an answer. */
static inline int spheres_covers(
    double x, double mass_ratio, double stiffness_ratio, double restitution, int loss)
{
    double ratio = mass_ratio / stiffness_ratio;
    return fabs(x) <= SPHERES_INCIDENCE_MAX
        && mass_ratio >= 1 && mass_ratio <= SPHERES_MASS_RATIO_MOST
        && stiffness_ratio <= SPHERES_STIFFNESS_MOST
        && ratio >= SPHERES_RATIO_LEAST && ratio <= SPHERES_RATIO_MOST
        && restitution >= SPHERES_RESTITUTION_MIN && restitution <= 1
        && (loss == SPHERES_VISCOUS || loss == SPHERES_PLASTIC);
}

/* Tangential velocity of the contact point at separation, v1(tf)/(mu v2(0)); NaN out of range. */
static inline double spheres_velocity(
    double x, double mass_ratio, double stiffness_ratio, double restitution, int loss)
{
    double size = fabs(x), velocity;
    struct spheres_spot spot;
    if (!spheres_covers(x, mass_ratio, stiffness_ratio, restitution, loss))
        return (double)NAN;
    spot = spheres_find(size / stiffness_ratio, mass_ratio / stiffness_ratio, restitution, loss);
    if (spot.slides) {
        velocity = size - (1 + restitution) * mass_ratio;
    } else {
        velocity = stiffness_ratio * spheres_spline(&spot, spot.panel->velocity);
        velocity = spheres_clipped(velocity, 0.0 - size, size);
    }
    return velocity * copysign(1.0, x);
}

/* The state at separation; NaN, and SPHERES_UNRESOLVED, out of range. */
static inline struct spheres_result spheres_rebound(
    double x, double mass_ratio, double stiffness_ratio, double restitution, int loss)
{
    struct spheres_result result = {(double)NAN, (double)NAN, (double)NAN, SPHERES_UNRESOLVED};
    double size = fabs(x), beta = mass_ratio, zeta2 = stiffness_ratio, e = restitution, w;
    struct spheres_spot spot;
    if (!spheres_covers(x, beta, zeta2, e, loss))
        return result;
    spot = spheres_find(size / zeta2, beta / zeta2, e, loss);
    if (spot.slides) {
        double change = (1 + e) * beta;
        w = size - change;
        result.peak_friction = 1.0;
        if (loss == SPHERES_VISCOUS)
            result.dissipation = (1 + e) * (size - zeta2 - (beta - zeta2) * (1 + e) / 2);
        else
            result.dissipation = (1 + e) * (size - change / 2);
        result.regime = SPHERES_SLIP_THROUGHOUT;
    } else {
        double peak = spheres_spline(&spot, spot.panel->peak);
        w = spheres_clipped(zeta2 * spheres_spline(&spot, spot.panel->velocity), 0.0 - size, size);
        result.peak_friction = spheres_clipped(peak, 0.0, 1.0);
        if (loss == SPHERES_VISCOUS) {
            double work = zeta2 * spheres_spline(&spot, spot.panel->work);
            result.dissipation = work > 0 ? work : 0.0;
        } else {
            result.dissipation = (size - w) * (size + w) / (2 * beta);
        }
        result.regime = size > zeta2 ? SPHERES_SLIP_STICK_SLIP : SPHERES_STICK_SLIP;
        if (!(size > 0.0))
            result.regime = SPHERES_STICK;
    }
    result.velocity = w * copysign(1.0, x);
    return result;
}

#endif
