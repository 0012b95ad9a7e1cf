/*
 * spheres.h: impacts of rough spheres, every impact with bodies and materials of its own.
 *
 * A ball that bounces on a floor at rest (z is up; metres, kilograms, radians, seconds):
 *   #include "spheres.h"
 *
 *   struct spheres_body ball = spheres_solid_sphere_by_mass(0.03, 0.1);
 *   struct spheres_pair rubber = {
 *       .friction = 0.8, .stiffness_ratio = 1.5, .restitution = 0.9, .loss = SPHERES_VISCOUS};
 *   struct spheres_vector up = {0, 0, 1}, velocity = {3, 0, -4}, spin = {0, -50, 0};
 *   struct spheres_collision hit = spheres_bounce(rubber, up, ball, velocity, spin);
 *   velocity = hit.velocity;
 *   spin = hit.spin;
 * In C++ before C++20: `spheres_pair rubber = {}; rubber.friction = 0.8;` and so on.
 * Where there is no answer, all numbers are NaN and the regime is SPHERES_UNRESOLVED.
 * spheres_problem, with the arguments of spheres_collide, then says what is wrong. A field that you
 * leave out is 0, restitution too.
 *
 * <version>
 * Written by planarimpact $value. Do not edit it: write it anew.
 * </version>
 *
 * <about>
$text
 * </about>
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
#include <stddef.h>

/* <public> */
#define SPHERES_$name $value
/* </public> */

/*
 * <constants>
$text
 * </constants>
 */
/* <private> */
#define SPHERES_$name $value
/* </private> */

/*
 * <table>
$text
 * </table>
 */

static const double spheres_limits[] = {
/* <limits> */
$numbers,
/* </limits> */
};

struct spheres_panel {
    int patch, patches, varying, rows, columns, over_t, over_u, edges, velocity, peak, work;
};
static const struct spheres_panel spheres_panels[] = {
/* <panels> */
{$row},
/* </panels> */
};

static const int spheres_patches[] = {
/* <patches> */
$numbers,
/* </patches> */
};

static const int spheres_values[] = {
/* <values> */
$numbers,
/* </values> */
};

/* Viscous restitution over the root of the relaxation time, a series of Chebyshev's polynomials. */
static const double spheres_series[] = {
/* <series> */
$numbers,
/* </series> */
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
    double scale; /* y in the first patch, else 1 */
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

/*
 * Velocity of a contact that sticks for a while, from x, and the velocity if it slid throughout:
 * within the energy that there is, and what friction can do.
 */
static inline double spheres_sticking(
    const struct spheres_spot *spot, double x, double zeta2, double sliding)
{
    double least = sliding > 0.0 - x ? sliding : 0.0 - x;
    double share = spheres_spline(spot, spot->panel->velocity) * spot->scale;
    return spheres_clipped(zeta2 * share + 0.0, least, x); /* no -0 */
}

static inline struct spheres_spot spheres_find(double y, double b, double e, int loss)
{
    const double least = SPHERES_E_LEAST_PLASTIC, unit = SPHERES_UNIT;
    double u = loss == SPHERES_VISCOUS ? (b - SPHERES_B_LEAST_VISCOUS) / SPHERES_B_SPAN_VISCOUS
        : (b - SPHERES_B_LEAST_PLASTIC) / SPHERES_B_SPAN_PLASTIC;
    double at = u * SPHERES_INTERVALS, t, over, across;
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
        t = (e - SPHERES_E_LEAST_VISCOUS) / (1 - SPHERES_E_LEAST_VISCOUS);
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
        edge[2] = 1 + (b - 1) * varying[0];
        edge[3] = 1 + (b - 1) * varying[1];
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
    spot.scale = which == panel->patch ? y : 1;
    spot.slides = y >= edge[panel->patches] * SPHERES_NEARLY;
    spot.base = patch[2] + spheres_place(s, patch[1], spot.over_s);
    spot.base = spot.base * panel->over_t + spheres_place(t, panel->over_t - 3, spot.over_t);
    spot.base = spot.base * panel->over_u + spheres_place(u, panel->over_u - 3, spot.over_u);
    return spot;
}

/* The least restitution of a loss in the table. */
static inline double spheres_least_restitution(int loss)
{
    return loss == SPHERES_VISCOUS ? SPHERES_RESTITUTION_MIN_VISCOUS
        : SPHERES_RESTITUTION_MIN_PLASTIC;
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
        && restitution >= spheres_least_restitution(loss) && restitution <= 1
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
    velocity = size - (1 + restitution) * mass_ratio;
    if (!spot.slides)
        velocity = spheres_sticking(&spot, size, stiffness_ratio, velocity);
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
    w = size - (1 + e) * beta;
    if (spot.slides) {
        double change = (1 + e) * beta;
        result.peak_friction = 1.0;
        if (loss == SPHERES_VISCOUS)
            result.dissipation = (1 + e) * (size - zeta2 - (beta - zeta2) * (1 + e) / 2);
        else
            result.dissipation = (1 + e) * (size - change / 2);
        result.regime = SPHERES_SLIP_THROUGHOUT;
    } else {
        double peak = spheres_spline(&spot, spot.panel->peak) * spot.scale;
        w = spheres_sticking(&spot, size, zeta2, w);
        result.peak_friction = spheres_clipped(peak, 0.0, 1.0);
        if (loss == SPHERES_VISCOUS) {
            double work = spheres_spline(&spot, spot.panel->work) * spot.scale * spot.scale;
            result.dissipation = work > 0 ? zeta2 * work : 0.0;
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

struct spheres_vector {
    double x, y, z;
};

struct spheres_body {
    double mass;
    double gyration;
    double radius;
};

struct spheres_pair {
    double friction;
    double stiffness_ratio;
    double restitution;
    double relaxation_time;
    double yield_pressure;
    double effective_modulus;
    int loss;
};

struct spheres_collision {
    struct spheres_vector velocity;
    struct spheres_vector spin;
    struct spheres_vector other_velocity;
    struct spheres_vector other_spin;
    struct spheres_vector impulse;
    double incidence;
    double restitution;
    double error_bound;
    int regime;
};

/* A flat body that neither moves nor turns by an impact; it may have a velocity. */
static const struct spheres_body SPHERES_WALL = {(double)INFINITY, (double)INFINITY, 0};

/* A homogeneous sphere, from its radius [m] and its mass [kg]. */
static inline struct spheres_body spheres_solid_sphere_by_mass(double radius, double mass)
{
    struct spheres_body body = {0, 0, 0};
    body.mass = mass;
    body.gyration = radius * sqrt(0.4);
    body.radius = radius;
    return body;
}

/* A homogeneous sphere, from its radius [m] and its density [kg/m^3]. */
static inline struct spheres_body spheres_solid_sphere_by_density(double radius, double density)
{
    const double volume_factor = 4.0 / 3 * 3.141592653589793;
    return spheres_solid_sphere_by_mass(
        radius, density * radius * radius * radius * volume_factor);
}

/* A thin hollow sphere, from its radius [m] and its mass [kg]. */
static inline struct spheres_body spheres_thin_shell(double radius, double mass)
{
    struct spheres_body body = {0, 0, 0};
    body.mass = mass;
    body.gyration = radius * sqrt(2.0 / 3);
    body.radius = radius;
    return body;
}

static inline double spheres_dot(struct spheres_vector a, struct spheres_vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline struct spheres_vector spheres_cross(struct spheres_vector a, struct spheres_vector b)
{
    struct spheres_vector c = {0, 0, 0};
    c.x = a.y * b.z - a.z * b.y;
    c.y = a.z * b.x - a.x * b.z;
    c.z = a.x * b.y - a.y * b.x;
    return c;
}

static inline struct spheres_vector spheres_scaled(double factor, struct spheres_vector a)
{
    a.x *= factor;
    a.y *= factor;
    a.z *= factor;
    return a;
}

/* a + factor b */
static inline struct spheres_vector spheres_sum(
    struct spheres_vector a, double factor, struct spheres_vector b)
{
    a.x += factor * b.x;
    a.y += factor * b.y;
    a.z += factor * b.z;
    return a;
}

/* The fifth root of a number above 0. That of a library differs from one language to the next. */
static inline double spheres_fifth_root(double value)
{
    double scale = 1, root;
    int i;
    if (!(value > 0 && value <= 1e308))
        return (double)NAN;
    for (; value > 32; value *= 0.03125)
        scale *= 2;
    for (; value < 1; value *= 32)
        scale *= 0.5;
    root = 1 + (value - 1) / (14 + value);
    for (i = 0; i < 4; ++i) { /* Halley's method */
        double power = root * root * root * root * root;
        root *= (2 * power + 3 * value) / (3 * power + 2 * value);
    }
    return root * scale;
}

/* Whether the loss that goes with a restitution is one, or is left out where nothing is lost. */
static inline int spheres_knows_loss(struct spheres_pair pair)
{
    return pair.loss == SPHERES_VISCOUS || pair.loss == SPHERES_PLASTIC
        || (pair.loss == 0 && pair.restitution == 1);
}

/* Restitution of a pair at a normal speed, of bodies with this effective mass and radius. */
static inline double spheres_restitution_at(
    struct spheres_pair pair, double mass, double radius, double speed)
{
    double modulus = pair.effective_modulus;
    int fixed = pair.restitution != 0 || pair.loss != 0;
    if (fixed + (pair.relaxation_time != 0) + (pair.yield_pressure != 0) != 1)
        return (double)NAN;
    if (pair.yield_pressure != 0) {
        /* Thornton's sphere, with lengths over (m2 v2^2/(E* R^(1/2)))^(2/5): a is the radius of
           contact where it yields, the approach is then a^2, and at the end `depth`. */
        double first = modulus / mass * radius / speed * radius / speed * radius;
        double a = 1.5707963267948966 * (pair.yield_pressure / modulus) * spheres_fifth_root(first);
        double left = 1 - a * a * a * a * a * (16.0 / 15), part = 2.0 / 3 * (a * a), reach, depth;
        if (!(a > 0))
            return (double)NAN;
        if (!(left > 0))
            return 1;
        reach = sqrt(part * part + left / (2 * a));
        depth = a * a / 3 + reach;
        return spheres_clipped(2 * a * reach * sqrt(0.6 / sqrt(depth)), 0, 1);
    }
    if (pair.relaxation_time != 0) {
        double stiff = modulus / mass;
        double tau = pair.relaxation_time * spheres_fifth_root(stiff * radius * stiff * speed);
        double at = 2 * (sqrt(tau) / SPHERES_SPAN) - 1, sum = 0, last = 0;
        int i;
        if (!(tau >= 0 && tau <= SPHERES_LONGEST))
            return (double)NAN;
        for (i = SPHERES_SERIES - 1; i > 0; --i) { /* Clenshaw's method */
            double next = spheres_series[i] + 2 * at * sum - last;
            last = sum;
            sum = next;
        }
        return spheres_clipped(spheres_series[0] + at * sum - last, SPHERES_LEAST, 1);
    }
    return spheres_knows_loss(pair) ? pair.restitution : (double)NAN;
}

/* 1/r; 0 where the radius is 0, as of a wall, which is flat. */
static inline double spheres_curvature(struct spheres_body body)
{
    return body.radius > 0 ? 1 / body.radius : 0;
}

#define SPHERES_TEXT(number) SPHERES_QUOTED(number)
#define SPHERES_QUOTED(number) #number

static inline int spheres_is_finite(struct spheres_vector a)
{
    const double most = (double)INFINITY;
    return fabs(a.x) < most && fabs(a.y) < most && fabs(a.z) < most;
}

/* Whether a vector stays finite where its components change by up to so much. */
static inline int spheres_may_change(struct spheres_vector a, double change)
{
    return fabs(a.x) + fabs(a.y) + fabs(a.z) + change < (double)INFINITY;
}

/* An impact that is to come. */
struct spheres_impact {
    struct spheres_vector normal; /* length 1 to rounding */
    struct spheres_vector tangent; /* where the contact point goes along the surface, length 1 */
    double share, other_share; /* m2 over the mass of each body */
    double v1, v2, unit, m2, beta, zeta2, e, x; /* v1 = unit x, unit = mu v2 */
    int loss, regime; /* UNRESOLVED without an answer, NO_IMPACT if nothing approaches, or STICK */
};

/*
 * Prepares an impact, and says what is wrong with the arguments: the field, and what is allowed;
 * NULL where there is an answer.
 */
static inline const char *spheres_before(
    struct spheres_impact *impact, struct spheres_pair pair, struct spheres_vector normal,
    struct spheres_body body, struct spheres_vector velocity, struct spheres_vector spin,
    struct spheres_body other, struct spheres_vector other_velocity,
    struct spheres_vector other_spin)
{
    const struct spheres_impact unknown = {
        {0, 0, 0}, {0, 0, 0}, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, SPHERES_UNRESOLVED};
    const double most = (double)INFINITY;
    const int is_fixed = pair.restitution != 0 || pair.loss != 0;
    struct spheres_vector n, turn, point, sideways;
    double length = sqrt(spheres_dot(normal, normal)), lighter, inverse, other_inverse, arm;
    double other_arm, along, v1, v2, m2, speed, unit;
    *impact = unknown;
    if (!spheres_is_finite(normal))
        return "normal: allowed is a vector of three finite numbers";
    if (!spheres_is_finite(velocity))
        return "velocity: allowed is a vector of three finite numbers";
    if (!spheres_is_finite(spin))
        return "spin: allowed is a vector of three finite numbers";
    if (!spheres_is_finite(other_velocity))
        return "other_velocity: allowed is a vector of three finite numbers";
    if (!spheres_is_finite(other_spin))
        return "other_spin: allowed is a vector of three finite numbers";
    if (!(fabs(length - 1) <= SPHERES_LENGTH_ERROR))
        return "normal: allowed is a vector whose length is within 1e-6 of 1";

    if (!(body.mass > 0))
        return "body.mass: allowed is a number above 0";
    if (!(body.gyration > 0))
        return "body.gyration: allowed is a number above 0";
    if (!(body.radius >= 0 && body.radius < most))
        return "body.radius: allowed is a finite number from 0";
    if (!(other.mass > 0))
        return "other.mass: allowed is a number above 0";
    if (!(other.gyration > 0))
        return "other.gyration: allowed is a number above 0";
    if (!(other.radius >= 0 && other.radius < most))
        return "other.radius: allowed is a finite number from 0";
    lighter = body.mass < other.mass ? body.mass : other.mass;
    if (!(lighter < most))
        return "body.mass: allowed is a finite number where other.mass is not one";

    if (!(pair.friction >= 0 && pair.friction < most))
        return "pair.friction: allowed is a finite number from 0";
    if (!(pair.stiffness_ratio > 0 && pair.stiffness_ratio <= SPHERES_STIFFNESS_MOST))
        return "pair.stiffness_ratio: allowed is a number above 0, up to "
            SPHERES_TEXT(SPHERES_STIFFNESS_MAX);
    inverse = lighter / body.mass;
    other_inverse = lighter / other.mass;
    impact->share = inverse / (inverse + other_inverse);
    impact->other_share = other_inverse / (inverse + other_inverse);
    arm = body.radius / body.gyration;
    other_arm = other.radius / other.gyration;
    impact->beta = (1 + arm * arm) * impact->share
        + (1 + other_arm * other_arm) * impact->other_share;
    impact->loss = pair.loss == SPHERES_PLASTIC || pair.yield_pressure > 0
        ? SPHERES_PLASTIC : SPHERES_VISCOUS;
    if (!spheres_covers(0, impact->beta, pair.stiffness_ratio, 1, impact->loss))
        return "mass_ratio/stiffness_ratio: allowed is a number from "
            SPHERES_TEXT(SPHERES_RATIO_MIN) " to " SPHERES_TEXT(SPHERES_RATIO_MAX);

    if (is_fixed + (pair.relaxation_time != 0) + (pair.yield_pressure != 0) != 1)
        return "pair: allowed is either restitution with loss, or one of relaxation_time and "
            "yield_pressure, with effective_modulus and no loss";
    if (is_fixed) {
        if (!(pair.restitution >= 0 && pair.restitution <= 1))
            return "pair.restitution: allowed is a number from 0 to 1";
        if (!spheres_knows_loss(pair))
            return "pair.loss: allowed is the constant SPHERES_VISCOUS or SPHERES_PLASTIC; it may "
                "be left out where restitution is 1";
    } else {
        if (!(pair.effective_modulus > 0 && pair.effective_modulus < most))
            return "pair.effective_modulus: allowed is a finite number above 0";
        if (!(pair.relaxation_time >= 0 && pair.relaxation_time < most))
            return "pair.relaxation_time: allowed is a finite number above 0";
        if (!(pair.yield_pressure >= 0 && pair.yield_pressure < most))
            return "pair.yield_pressure: allowed is a finite number above 0";
    }

    /* Velocity of the contact point of the body against that of the other one. */
    n.x = normal.x / length;
    n.y = normal.y / length;
    n.z = normal.z / length;
    turn = spheres_sum(spheres_scaled(body.radius, spin), other.radius, other_spin);
    point = spheres_sum(spheres_sum(velocity, -1, other_velocity), -1, spheres_cross(turn, n));
    along = spheres_dot(point, n);
    if (along >= 0 && along < most) {
        impact->regime = SPHERES_NO_IMPACT;
        return NULL;
    }
    /* What can change is bounded, so that no number of the result overflows. */
    sideways = spheres_sum(point, -along, n);
    v1 = sqrt(spheres_dot(sideways, sideways));
    v2 = -along;
    m2 = lighter / (inverse + other_inverse);
    speed = 2 * (v1 + v2);
    if (!(m2 * v2 * v2 + m2 * v1 * v1 < most && m2 * speed < most && m2 / impact->beta > 0
          && spheres_may_change(velocity, speed) && spheres_may_change(other_velocity, speed)
          && spheres_may_change(spin, speed * impact->share * arm / body.gyration)
          && spheres_may_change(
              other_spin, speed * impact->other_share * other_arm / other.gyration)))
        return "velocity: allowed is a vector whose numbers are neither too large nor too small to "
            "compute with, as those of the spins and bodies are";
    unit = pair.friction * v2;
    if (unit > v1 / SPHERES_INCIDENCE_LEAST)
        unit = v1 / SPHERES_INCIDENCE_LEAST;
    if (!(unit < most))
        return "pair.friction: allowed is a number that stays finite times the normal velocity";

    impact->e = spheres_restitution_at(
        pair, m2, 1 / (spheres_curvature(body) + spheres_curvature(other)), v2);
    if (!(impact->e >= 0)) {
        if (pair.yield_pressure > 0)
            return "pair.yield_pressure: allowed is a smaller or a larger number";
        return "pair.relaxation_time: allowed is a number so small that e is above "
            SPHERES_TEXT(SPHERES_LEAST);
    }
    if (impact->e == 1) /* nothing is lost: the table of viscous spheres is nearer */
        impact->loss = SPHERES_VISCOUS;
    impact->normal = n;
    impact->tangent = spheres_scaled(v1 > 0 ? 1 / v1 : 0, sideways);
    impact->v2 = v2;
    impact->m2 = m2;
    impact->zeta2 = pair.stiffness_ratio;
    impact->v1 = v1;
    impact->unit = unit;
    impact->x = v1 > 0 ? v1 / unit : 0;
    impact->regime = SPHERES_STICK;
    return NULL;
}

/* What an impact of this loss adds to x, the tangential velocity; it finds the regime too. */
static inline double spheres_change(const struct spheres_impact *impact, int loss, int *regime)
{
    double x = impact->x, beta = impact->beta, zeta2 = impact->zeta2, e = impact->e;
    double slides = 0.0 - (1 + e) * beta, least = spheres_least_restitution(loss);
    int known = e >= least;
    struct spheres_spot spot;
    *regime = SPHERES_STICK;
    if (!(x > 0))
        return 0;
    *regime = SPHERES_SLIP_THROUGHOUT;
    if (x > SPHERES_INCIDENCE_MAX || (loss == SPHERES_VISCOUS && x >= beta + e * (beta - zeta2)))
        return slides;
    spot = spheres_find(x / zeta2, beta / zeta2, known ? e : least, loss);
    if (known && spot.slides)
        return slides;
    *regime = !known ? SPHERES_UNRESOLVED
        : x > zeta2 ? SPHERES_SLIP_STICK_SLIP : SPHERES_STICK_SLIP;
    return spot.slides ? slides : spheres_sticking(&spot, x, zeta2, x + slides) - x;
}

/* The collision of two bodies, or of one with a wall. */
static inline struct spheres_collision spheres_collide(
    struct spheres_pair pair, struct spheres_vector normal,
    struct spheres_body body, struct spheres_vector velocity, struct spheres_vector spin,
    struct spheres_body other, struct spheres_vector other_velocity,
    struct spheres_vector other_spin)
{
    const double nan = (double)NAN;
    struct spheres_impact impact;
    struct spheres_vector zero = {0, 0, 0}, unknown = {nan, nan, nan}, impulse, turn;
    struct spheres_collision after = {
        unknown, unknown, unknown, unknown, unknown, nan, nan, nan, SPHERES_UNRESOLVED};
    double change, along, twist;
    if (spheres_before(
            &impact, pair, normal, body, velocity, spin, other, other_velocity, other_spin))
        return after;
    after.regime = impact.regime;
    after.velocity = velocity;
    after.spin = spin;
    after.other_velocity = other_velocity;
    after.other_spin = other_spin;
    after.impulse = zero;
    if (impact.regime == SPHERES_NO_IMPACT)
        return after;

    change = spheres_change(&impact, impact.loss, &after.regime);
    /* The impulse is over m2, as velocities are in the range of numbers. */
    along = impact.unit * (change / impact.beta);
    impulse = spheres_scaled(impact.v2 * (1 + impact.e), impact.normal);
    impulse = spheres_sum(impulse, along, impact.tangent);
    after.impulse = spheres_scaled(impact.m2, impulse);
    turn = spheres_cross(impact.normal, impact.tangent);
    after.velocity = spheres_sum(velocity, impact.share, impulse);
    after.other_velocity = spheres_sum(other_velocity, 0.0 - impact.other_share, impulse);
    twist = 0.0 - along;
    after.spin = spheres_sum(
        spin, twist * impact.share * (body.radius / body.gyration) / body.gyration, turn);
    after.other_spin = spheres_sum(
        other_spin,
        twist * impact.other_share * (other.radius / other.gyration) / other.gyration, turn);
    after.incidence = impact.x;
    after.restitution = impact.e;
    if (after.regime == SPHERES_STICK || after.regime == SPHERES_SLIP_THROUGHOUT)
        after.error_bound = 0;
    else if (after.regime != SPHERES_UNRESOLVED)
        after.error_bound = (impact.unit < impact.v1 ? impact.unit : impact.v1)
            * (impact.zeta2 > SPHERES_STIFFNESS_STATED ? impact.zeta2 / SPHERES_STIFFNESS_STATED : 1)
            * (impact.loss == SPHERES_VISCOUS ? SPHERES_ERROR_VISCOUS : SPHERES_ERROR_PLASTIC);
    return after;
}

/*
 * What is wrong with the arguments of `spheres_collide`: the field, and what is allowed; NULL where
 * there is an answer. Call it where the numbers are NaN and the regime is SPHERES_UNRESOLVED.
 */
static inline const char *spheres_problem(
    struct spheres_pair pair, struct spheres_vector normal,
    struct spheres_body body, struct spheres_vector velocity, struct spheres_vector spin,
    struct spheres_body other, struct spheres_vector other_velocity,
    struct spheres_vector other_spin)
{
    struct spheres_impact impact;
    return spheres_before(
        &impact, pair, normal, body, velocity, spin, other, other_velocity, other_spin);
}

/* The collision of a body with a surface at rest. */
static inline struct spheres_collision spheres_bounce(
    struct spheres_pair pair, struct spheres_vector normal,
    struct spheres_body body, struct spheres_vector velocity, struct spheres_vector spin)
{
    struct spheres_vector zero = {0, 0, 0};
    return spheres_collide(pair, normal, body, velocity, spin, SPHERES_WALL, zero, zero);
}

/*
 * How far the velocity of the contact point after the impact would move with the other loss [m/s];
 * NaN where there is no answer, or no impact.
 */
static inline double spheres_model_form(
    struct spheres_pair pair, struct spheres_vector normal,
    struct spheres_body body, struct spheres_vector velocity, struct spheres_vector spin,
    struct spheres_body other, struct spheres_vector other_velocity,
    struct spheres_vector other_spin)
{
    struct spheres_impact impact;
    double viscous, plastic;
    int one, two;
    if (spheres_before(
            &impact, pair, normal, body, velocity, spin, other, other_velocity, other_spin)
        || impact.regime == SPHERES_NO_IMPACT)
        return (double)NAN;
    if (!(impact.e < 1))
        return 0;
    viscous = spheres_change(&impact, SPHERES_VISCOUS, &one);
    plastic = spheres_change(&impact, SPHERES_PLASTIC, &two);
    if (one == SPHERES_UNRESOLVED || two == SPHERES_UNRESOLVED)
        return (double)NAN;
    return impact.unit * fabs(viscous - plastic);
}

/* A body and its pair of materials, with the source of the numbers. */
struct spheres_preset {
    struct spheres_body body;
    struct spheres_pair pair;
};
/* <presets> */
/*
$text
 */
static const struct spheres_preset spheres_$name = {
    {$mass, $gyration, $radius},
    {$friction, $stiffness_ratio, $restitution,
     $relaxation_time, $yield_pressure, $effective_modulus, $loss}};
/* </presets> */

#endif
