/*
 * pair.h: the rebound of one pair of rough bodies after an oblique impact.
 *
 * <model>
 * A template: the package replaces what stands between two marks, the prefix of all names, and the
 * name of this file. Here is a rigid body, fitted with the tolerance 0.01.
 * </model>
 *
 * Functions of the incidence x = v1(0)/(mu v2(0)), of any sign:
 *   pair_velocity(x) is the velocity alone.
 *   pair_rebound(x) has
 *     velocity: v1(tf)/(mu v2(0)), which has the sign opposite to x where the contact point has
 *       turned round
 *     peak_friction: largest friction, over mu times the largest normal force
 *     dissipation: work of friction, in mu^2 m2 v2(0)^2
 *     regime: the order of stick and slip, one of the codes below
 *
 * Units and signs: v1 and v2 are the tangential and the normal velocity of the contact point,
 * before the impact (0) and after it (tf), both in one unit. v2(0) is positive towards the
 * surface. mu is the coefficient of friction, above 0.
 *
 * Range: |x| up to PAIR_INCIDENCE_MAX. For any other x, NaN among them, the numbers are NaN and
 * the regime is PAIR_UNRESOLVED.
 *
 * Measured error against the model: PAIR_ERROR_VELOCITY for velocity and PAIR_ERROR_PEAK_FRICTION
 * for peak_friction. That is twice the largest difference that a search found, plus the tolerance
 * of the model if it has one. Nothing is proved: a narrow kink of the model may have escaped the
 * search. A regime changes within a hundredth of the tolerance of the fit from where that of the
 * model does.
 *
 * Example:
 *   #include "pair.h"
 *
 *   double v1 = 6.0, v2 = 5.0, mu = 0.8; // before the impact
 *   double v1_after = mu * v2 * pair_velocity(v1 / (mu * v2));
 *   double v2_after = -PAIR_RESTITUTION * v2;
 */

#ifndef PLANARIMPACT_PAIR_H
#define PLANARIMPACT_PAIR_H

/* A compiler without NaN may drop the test of the range, and a table is read beyond its ends. GCC
   and Clang always define the first of these names, MSVC defines the last with /fp:fast. */
#if defined(__FINITE_MATH_ONLY__) ? __FINITE_MATH_ONLY__ : defined(__FAST_MATH__)
#error "This header needs NaN: add -fno-finite-math-only after -ffast-math"
#elif defined(_M_FP_FAST)
#error "This header needs NaN: compile it without /fp:fast"
#endif

#include <math.h>

/* <public> */
#define PAIR_MASS_RATIO 3.5
#define PAIR_STIFFNESS_RATIO 1.21
#define PAIR_RESTITUTION 1.0
#define PAIR_INCIDENCE_MAX 8e+307
#define PAIR_ERROR_VELOCITY 0.0
#define PAIR_ERROR_PEAK_FRICTION 3.257481802076967e-07
#define PAIR_STICK 0
#define PAIR_SLIP_STICK 1
#define PAIR_STICK_SLIP 2
#define PAIR_SLIP_STICK_SLIP 3
#define PAIR_SLIP_THROUGHOUT 4
#define PAIR_MULTIPLE 5
#define PAIR_UNRESOLVED 6
/* </public> */

/*
 * Numbers of the functions below.
 *   SCALE: cells of first for each unit of |x|
 *   SLIDES_FROM: the |x| from which on the contact slides throughout
 *   CHANGE, IMPULSE: changes of tangential and of normal velocity there
 *   GAINS: 1 if the model may gain energy; if 0, velocities are at most |x|, so that rounding and
 *     the fit create none
 */
/* <private> */
#define PAIR_SCALE 9.142857142857142
#define PAIR_SLIDES_FROM 7.0
#define PAIR_CHANGE 7.0
#define PAIR_IMPULSE 2.0
#define PAIR_GAINS 0
/* </private> */

/*
 * Polynomials over pieces of |x|, in the variable sqrt(|x| - kink) - centre.
 *   start: left ends of the pieces, and infinity
 *   first: the piece at the left of each cell of equal width, where the search begins
 *   rows: kink, centre, 8 coefficients of velocity and 8 of peak friction in ascending powers
 *   label: regime of the piece
 */

static const double pair_start[] = {
/* <start> */
0.0,0.875,3.5,4.375,(double)INFINITY,
/* </start> */
};

static const unsigned short pair_first[] = {
/* <first> */
0,0,0,0,0,0,0,0,0,1,1,1,1,1,1,1,1,1,1,1,
1,1,1,1,1,1,1,1,1,1,1,1,1,2,2,2,2,2,2,2,
2,3,3,3,3,3,3,3,3,3,3,3,3,3,3,3,3,3,3,3,
3,3,3,3,3,
/* </first> */
};

static const double pair_rows[] = {
/* <rows> */
0.0,0.4677,0.0,0.0,0.0,0.0,
0.0,0.0,0.0,0.0,0.348,0.72,
-0.0778,-0.05846,-0.005035,-0.00264,-0.0006057,-0.0002715,
0.0,1.403,0.0,0.0,0.0,0.0,
0.0,0.0,0.0,0.0,0.8992,0.3901,
-0.3031,-0.1233,-0.04261,-0.02266,-0.01557,-0.009676,
3.5,0.4677,0.0,0.0,0.0,0.0,
0.0,0.0,0.0,0.0,1.0,0.0,
0.0,0.0,0.0,0.0,0.0,0.0,
3.5,1.403,0.0,0.0,0.0,0.0,
0.0,0.0,0.0,0.0,1.0,0.0,
0.0,0.0,0.0,0.0,0.0,0.0,
/* </rows> */
};

static const unsigned char pair_label[] = {
/* <label> */
1,1,1,1,
/* </label> */
};

struct pair_result {
    double velocity;
    double peak_friction;
    double dissipation;
    int regime;
};

/* The piece of a size |x|. */
static inline int pair_piece(double size)
{
    int piece = pair_first[(int)(size * PAIR_SCALE)];
    while (size >= pair_start[piece + 1])
        ++piece;
    return piece;
}

/* Its variable there. */
static inline double pair_root(int piece, double size)
{
    const double *row = pair_rows + 18 * piece;
    return sqrt(size - row[0]) - row[1];
}

/* A polynomial with these coefficients of ascending powers. */
static inline double pair_polynomial(const double *c, double root)
{
    double value = c[7];
    value = value * root + c[6];
    value = value * root + c[5];
    value = value * root + c[4];
    value = value * root + c[3];
    value = value * root + c[2];
    value = value * root + c[1];
    value = value * root + c[0];
    return value;
}

static inline double pair_clipped(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* Velocity for |x|, at most so large, where the contact does not slide throughout. For most = 0
   both bounds are 0: -most would be -0. */
static inline double pair_fitted(int piece, double root, double most)
{
    return pair_clipped(pair_polynomial(pair_rows + 18 * piece + 2, root), 0.0 - most, most);
}

/* Tangential velocity of the contact point at separation, v1(tf)/(mu v2(0)); NaN out of range. */
static inline double pair_velocity(double x)
{
    double size = fabs(x), velocity;
    if (!(size <= PAIR_INCIDENCE_MAX))
        return (double)NAN;
    if (size >= PAIR_SLIDES_FROM) {
        velocity = size - PAIR_CHANGE;
    } else {
        int piece = pair_piece(size);
        velocity = pair_fitted(piece, pair_root(piece, size), PAIR_GAINS ? (double)INFINITY : size);
    }
    return velocity * copysign(1.0, x);
}

/* The state at separation; NaN, and PAIR_UNRESOLVED, out of range. */
static inline struct pair_result pair_rebound(double x)
{
    struct pair_result result = {(double)NAN, (double)NAN, (double)NAN, PAIR_UNRESOLVED};
    double size = fabs(x), impulse;
    if (!(size <= PAIR_INCIDENCE_MAX))
        return result;
    if (size >= PAIR_SLIDES_FROM) {
        result.velocity = size - PAIR_CHANGE;
        impulse = PAIR_IMPULSE;
        result.peak_friction = 1.0;
        result.regime = PAIR_SLIP_THROUGHOUT;
    } else {
        int piece = pair_piece(size);
        double root = pair_root(piece, size);
        const double *c = pair_rows + 18 * piece + 10;
        result.velocity = pair_fitted(piece, root, PAIR_GAINS ? (double)INFINITY : size);
        impulse = (size - result.velocity) / PAIR_MASS_RATIO;
        result.peak_friction = pair_clipped(pair_polynomial(c, root), 0.0, 1.0);
        result.regime = pair_label[piece];
    }
    if (!(size > 0.0))
        result.regime = PAIR_STICK;
    result.dissipation = impulse * (size / 2.0 + result.velocity / 2.0);
    result.velocity *= copysign(1.0, x);
    return result;
}

#endif
