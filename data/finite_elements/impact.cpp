// One oblique impact of an elastic-perfectly-plastic sphere, by explicit finite elements.
//
// The sphere is a half-space of small strain with the gap r^2/2 (R = 1, E* = 1 for one body on a
// rigid plane), seen from the frame of its far body: there, the opposite plane comes closer by D
// and moves sideways by -U. The far body is rigid and has the only real mass: m2 = 1 normally,
// m2/3.5 tangentially. Without yielding it would come D = 1 near, so a = 1 and P = 4/3. Times are
// printed in units of that approach over the normal speed before the impact.
//
// The mesh is quasi-static: element masses are scaled so that a wave needs the same number of
// steps through every element, and an impact lasts some hundred passages through the mesh.
// Time in the mesh is counted in steps.
//
// Two spheres ("mirror"): the second is the first, rotated by 180 degrees about y. So node (x, y)
// meets node (-x, y) of the same mesh, and the means of both take the place of one node's
// displacement. "plane": the opposite body is rigid, every node meets it by itself.
//
// Arguments are name=value, all required; results are printed as name,value.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace {

// A row of elements along x is worked on in blocks of eight, one element per lane.
constexpr int W = 8;
typedef double Block __attribute__((vector_size(8 * W)));
typedef std::vector<double> Array;

Block load(const double *p) { Block b; std::memcpy(&b, p, sizeof b); return b; }
void store(double *p, Block b) { std::memcpy(p, &b, sizeof b); }
double sum(Block b) { double s = 0; for (int l = 0; l < W; ++l) s += b[l]; return s; }
Block root(Block b) { Block r; for (int l = 0; l < W; ++l) r[l] = std::sqrt(b[l]); return r; }
bool any_above(Block a, Block b) {
  auto m = a > b;
  long long any = 0;
  for (int l = 0; l < W; ++l) any |= m[l];
  return any != 0;
}
// The block moved up by one lane; the last lane of the block before it comes in.
Block shifted(Block before, Block b) {
  typedef long long Lanes __attribute__((vector_size(8 * W)));
  return __builtin_shuffle(before, b, Lanes{7, 8, 9, 10, 11, 12, 13, 14});
}

// Values at the 8 corners (bit 0: x, bit 1: y, bit 2: z) to 8 times the coefficients of
// 1, X, Y, XY, Z, XZ, YZ, XYZ with X, Y, Z from -1 to 1; its own inverse up to the factor 8.
void corners_to_modes(Block *c) {
  for (int bit : {1, 2, 4})
    for (int n = 0; n < 8; ++n)
      if (!(n & bit)) { Block l = c[n], r = c[n | bit]; c[n] = r + l; c[n | bit] = r - l; }
}
void modes_to_corners(Block *c) {
  for (int bit : {1, 2, 4})
    for (int n = 0; n < 8; ++n)
      if (!(n & bit)) { Block a = c[n], d = c[n | bit]; c[n] = a - d; c[n | bit] = a + d; }
}
enum Mode { X = 1, Y = 2, XY = 3, Z = 4, XZ = 5, YZ = 6, XYZ = 7 };

struct Material { double young, shear, lame, yield, hardening; };

// Radial return of a deviatoric stress (xx, yy, zz, xy, yz, zx) of which `s2` is 3/2 s:s; gives the
// factor by which it shrinks and adds the plastic work per volume.
Block radial_return(const Material &m, Block s2, double *yield_stress, Block weight, Block &plastic) {
  Block yield = load(yield_stress), q = root(s2), none = q - q;
  Block excess = q - yield;
  Block strain = excess / (3 * m.shear + m.hardening);
  strain = excess > none ? strain : none;
  yield += m.hardening * strain;
  store(yield_stress, yield);
  plastic += weight * strain * yield;
  Block tiny = none + 1e-300;
  return 1.0 - 3 * m.shear * strain / (q + tiny);
}

struct Mesh {
  int ex, ey, ez;      // elements
  int row;             // nodes per row along x, padded
  int nodes;
  bool full;           // 2x2x2 integration with mean dilatation, or one point
  Material mat;
  Array x, y, z;       // coordinates of the node planes
  Array slope;         // 2/hx, one per element of a row (0 in the padding)
  Array width;         // hx
  Array v[3], f[3];    // velocity per step; force of the elements on the nodes
  Array state;         // all that elements remember, blockwise
  int per_element;     // number of doubles of it
  double plastic = 0;  // dissipated so far (in half the body)

  int node(int i, int j, int k) const { return i + row * (j + (ey + 1) * k); }

  void build(bool full_, Material m) {
    full = full_, mat = m;
    ex = x.size() - 1, ey = y.size() - 1, ez = z.size() - 1;
    row = (ex + 1 + W - 1) / W * W;
    nodes = row * (ey + 1) * (ez + 1);
    slope.assign(row, 0), width.assign(row, 0);
    for (int i = 0; i < ex; ++i) width[i] = x[i + 1] - x[i], slope[i] = 2 / width[i];
    // One point: 6 stresses, 12 hourglass forces, yield stress. Full: 8 times the deviatoric
    // stress and the yield stress, and one pressure.
    per_element = full ? 8 * 7 + 1 : 19;
    for (int c = 0; c < 3; ++c) v[c].assign(nodes + W, 0), f[c].assign(nodes + W, 0);
    clear();
  }
  void clear() {
    state.assign(size_t(row) * ey * ez * per_element, 0);
    for (size_t b = 0; b < state.size(); b += W * per_element)
      for (int g = 0; g < (full ? 8 : 1); ++g)
        for (int l = 0; l < W; ++l)
          state[b + W * (full ? 7 * g + 6 : 18) + l] = mat.yield;
    plastic = 0;
  }

  // Stresses after a step with the velocities v; their forces are added to f.
  template <bool FULL> void step_elements() {
    Block plastic_sum = {};
    double *s = state.data();
    for (int k = 0; k < ez; ++k)
      for (int j = 0; j < ey; ++j) {
        int line[4] = {node(0, j, k), node(0, j + 1, k), node(0, j, k + 1), node(0, j + 1, k + 1)};
        double hy = y[j + 1] - y[j], hz = z[k + 1] - z[k];
        Block before[12] = {};
        for (int i = 0; i < row; i += W, s += W * per_element) {
          Block c[3][8];
          for (int a = 0; a < 3; ++a) {
            for (int n = 0; n < 4; ++n) {
              const double *p = v[a].data() + line[n] + i;
              c[a][2 * n] = load(p), c[a][2 * n + 1] = load(p + 1);
            }
            corners_to_modes(c[a]);
          }
          Block volume = load(&width[i]) * (hy * hz);
          Block d[3] = {load(&slope[i]), volume * 0 + 2 / hy, volume * 0 + 2 / hz};
          if (FULL) eight_points(c, d, volume, s, plastic_sum);
          else one_point(c, d, volume, s, plastic_sum);
          for (int a = 0; a < 3; ++a) {
            modes_to_corners(c[a]);
            for (int n = 0; n < 4; ++n) {
              double *p = f[a].data() + line[n] + i;
              store(p, load(p) - (c[a][2 * n] + shifted(before[4 * a + n], c[a][2 * n + 1])) * 0.125);
              before[4 * a + n] = c[a][2 * n + 1];
            }
          }
        }
      }
    plastic += sum(plastic_sum);
  }
  void step_elements() { full ? step_elements<true>() : step_elements<false>(); }

  // c: in, 8 times the modes of the displacement increment; out, the forces on the modes.
  //
  // One point, hourglass modes carried by elastic stiffness: a bending mode by E, as slender bending
  // would be, a twist by G. Their forces shrink with the radial return of the element's stress, as
  // the flow rule has it for every small fluctuation of stress: else the modes would stay stiff in
  // a body that flows.
  void one_point(Block c[3][8], const Block d[3], Block volume, double *s, Block &plastic_sum) {
    for (int a = 0; a < 3; ++a)
      for (int n = 1; n < 8; ++n) c[a][n] *= 0.125;
    double G2 = 2 * mat.shear;
    Block xx = c[0][X] * d[0], yy = c[1][Y] * d[1], zz = c[2][Z] * d[2];
    Block trace = mat.lame * (xx + yy + zz);
    Block t[6];
    for (int n = 0; n < 6; ++n) t[n] = load(s + W * n);
    t[0] += trace + G2 * xx, t[1] += trace + G2 * yy, t[2] += trace + G2 * zz;
    t[3] += mat.shear * (c[0][Y] * d[1] + c[1][X] * d[0]);
    t[4] += mat.shear * (c[1][Z] * d[2] + c[2][Y] * d[1]);
    t[5] += mat.shear * (c[2][X] * d[0] + c[0][Z] * d[2]);
    Block third = volume * (1 / 3.0), ninth = third * (1 / 3.0);
    Block dd[3] = {d[0] * d[0], d[1] * d[1], d[2] * d[2]};
    const int own[3] = {X, Y, Z};
    Block h[12], stiff[12];
    for (int a = 0; a < 3; ++a) {
      int b = (a + 1) % 3, e = (a + 2) % 3;
      const int mode[4] = {own[a] | own[b], own[a] | own[e], own[b] | own[e], XYZ};
      Block bend = third * mat.young * dd[a], twist = third * mat.shear * (dd[b] + dd[e]);
      Block k[4] = {bend, bend, twist, ninth * (mat.young * dd[a] + mat.shear * (dd[b] + dd[e]))};
      for (int n = 0; n < 4; ++n) {
        stiff[4 * a + n] = k[n];
        h[4 * a + n] = load(s + W * (6 + 4 * a + n)) + k[n] * c[a][mode[n]];
      }
    }
    Block mean = (t[0] + t[1] + t[2]) / 3.0;
    Block p = t[0] - mean, q = t[1] - mean, r = t[2] - mean;
    Block s2 = 1.5 * (p * p + q * q + r * r) + 3.0 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]);
    Block yield = load(s + W * 18);
    if (any_above(s2, yield * yield)) {
      Block shrink = radial_return(mat, s2, s + W * 18, volume, plastic_sum);
      t[0] = mean + p * shrink, t[1] = mean + q * shrink, t[2] = mean + r * shrink;
      for (int n = 3; n < 6; ++n) t[n] *= shrink;
      Block lost = 0.5 * (1.0 - shrink * shrink);
      for (int n = 0; n < 12; ++n) {
        plastic_sum += lost * h[n] * h[n] / (stiff[n] + 1e-300);
        h[n] *= shrink;
      }
    }
    for (int n = 0; n < 6; ++n) store(s + W * n, t[n]);
    for (int n = 0; n < 12; ++n) store(s + W * (6 + n), h[n]);
    const int stress[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int a = 0; a < 3; ++a) {
      int b = (a + 1) % 3, e = (a + 2) % 3;
      c[a][0] = volume * 0;
      for (int g = 0; g < 3; ++g) c[a][own[g]] = volume * t[stress[a][g]] * d[g];
      c[a][own[a] | own[b]] = h[4 * a], c[a][own[a] | own[e]] = h[4 * a + 1];
      c[a][own[b] | own[e]] = h[4 * a + 2], c[a][XYZ] = h[4 * a + 3];
    }
  }

  // Eight points; the dilatation, and so the pressure, is that of the element's mean (B-bar).
  void eight_points(Block c[3][8], const Block d[3], Block volume, double *s, Block &plastic_sum) {
    for (int a = 0; a < 3; ++a)
      for (int n = 1; n < 8; ++n) c[a][n] *= 0.125;
    const double at = std::sqrt(1 / 3.0);
    const int own[3] = {X, Y, Z};
    Block dilatation = c[0][X] * d[0] + c[1][Y] * d[1] + c[2][Z] * d[2];
    Block mean = load(s + W * 56) + (mat.lame + 2 * mat.shear / 3) * dilatation;
    store(s + W * 56, mean);
    Block out[3][8];
    Block weight = volume * 0.125, zero = volume * 0;
    for (int a = 0; a < 3; ++a)
      for (int n = 0; n < 8; ++n) out[a][n] = zero;
    for (int g = 0; g < 8; ++g) {
      double pos[3] = {g & 1 ? at : -at, g & 2 ? at : -at, g & 4 ? at : -at};
      Block grad[3][3];  // of displacement a, along b
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          int e = (b + 1) % 3, h = (b + 2) % 3;
          grad[a][b] = d[b] * (c[a][own[b]] + c[a][own[b] | own[e]] * pos[e]
                               + c[a][own[b] | own[h]] * pos[h] + c[a][XYZ] * (pos[e] * pos[h]));
        }
      Block part = (grad[0][0] + grad[1][1] + grad[2][2]) / 3.0;
      double *m = s + W * 7 * g;
      Block t[6];
      for (int n = 0; n < 6; ++n) t[n] = load(m + W * n);
      for (int n = 0; n < 3; ++n) t[n] += 2 * mat.shear * (grad[n][n] - part);
      t[3] += mat.shear * (grad[0][1] + grad[1][0]);
      t[4] += mat.shear * (grad[1][2] + grad[2][1]);
      t[5] += mat.shear * (grad[2][0] + grad[0][2]);
      Block s2 = 1.5 * (t[0] * t[0] + t[1] * t[1] + t[2] * t[2])
                 + 3.0 * (t[3] * t[3] + t[4] * t[4] + t[5] * t[5]);
      Block yield = load(m + W * 6);
      if (any_above(s2, yield * yield)) {
        Block shrink = radial_return(mat, s2, m + W * 6, weight, plastic_sum);
        for (int n = 0; n < 6; ++n) t[n] *= shrink;
      }
      for (int n = 0; n < 6; ++n) store(m + W * n, t[n]);
      const int stress[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          int e = (b + 1) % 3, h = (b + 2) % 3;
          Block w = weight * d[b] * t[stress[a][b]];
          out[a][own[b]] += w;
          out[a][own[b] | own[e]] += w * pos[e];
          out[a][own[b] | own[h]] += w * pos[h];
          out[a][XYZ] += w * (pos[e] * pos[h]);
        }
    }
    for (int a = 0; a < 3; ++a) {
      out[a][own[a]] += volume * mean * d[a];
      for (int n = 0; n < 8; ++n) c[a][n] = out[a][n];
    }
  }

  // Elastic energy in the elements: what residual stress keeps after the impact.
  double stored() const {
    double total = 0;
    double bulk = mat.lame + 2 * mat.shear / 3;
    const double *s = state.data();
    for (int k = 0; k < ez; ++k)
      for (int j = 0; j < ey; ++j)
        for (int i = 0; i < row; i += W, s += W * per_element)
          for (int l = 0; l < W && i + l < ex; ++l) {
            double h[3] = {width[i + l], y[j + 1] - y[j], z[k + 1] - z[k]};
            double volume = h[0] * h[1] * h[2];
            for (int g = 0; g < (full ? 8 : 1); ++g) {
              double t[6];
              for (int n = 0; n < 6; ++n) t[n] = s[W * (7 * g * full + n) + l];
              double mean = full ? s[W * 56 + l] : (t[0] + t[1] + t[2]) / 3, dev = 0;
              for (int n = 0; n < 6; ++n) {
                double q = n < 3 && !full ? t[n] - mean : t[n];
                dev += (n < 3 ? 1 : 2) * q * q;
              }
              total += volume / (full ? 8 : 1) * (dev / (4 * mat.shear) + mean * mean / (2 * bulk));
            }
            if (!full)
              for (int a = 0; a < 3; ++a) {
                double D[3];
                for (int g = 0; g < 3; ++g) D[g] = 4 / (h[g] * h[g]);
                double bend = volume / 3 * mat.young * D[a];
                double twist = volume / 3 * mat.shear * (D[(a + 1) % 3] + D[(a + 2) % 3]);
                double k[4] = {bend, bend, twist, (bend + twist) / 3};
                for (int n = 0; n < 4; ++n) {
                  double q = s[W * (6 + 4 * a + n) + l];
                  total += q * q / (2 * k[n]);
                }
              }
          }
    return total;
  }
};

// Elements of size h up to `fine`, then growing by `ratio` up to `end`.
Array graded(double h, int fine, double ratio, double end) {
  Array at{0};
  for (int n = 0; n < fine; ++n) at.push_back(at.back() + h);
  double from = at.back();
  int count = std::max(1, int(std::lround(std::log(1 + (end - from) * (ratio - 1) / (h * ratio)) / std::log(ratio))));
  double total = 0;
  for (int n = 1; n <= count; ++n) total += std::pow(ratio, n);
  for (int n = 1; n <= count; ++n) at.push_back(at.back() + (end - from) * std::pow(ratio, n) / total);
  return at;
}

// Displacement of a half-space z > 0 under a unit force at its origin, along z and along x.
void boussinesq(double nu, double G, double x, double y, double z, double *u) {
  double r = std::sqrt(x * x + y * y + z * z), k = 1 / (4 * M_PI * G);
  double radial = z / (r * r * r) - (1 - 2 * nu) / (r * (r + z));
  u[0] = k * x * radial, u[1] = k * y * radial;
  u[2] = k * (z * z / (r * r * r) + 2 * (1 - nu) / r);
}
void cerruti(double nu, double G, double x, double y, double z, double *u) {
  double r = std::sqrt(x * x + y * y + z * z), k = 1 / (4 * M_PI * G);
  double near = (1 - 2 * nu) / (r + z), pair = 1 / (r * r * r) - near / (r * (r + z));
  u[0] = k * (1 / r + near + x * x * pair);
  u[1] = k * x * y * pair;
  u[2] = k * (x * z / (r * r * r) + near * x / r);
}

struct Pair {           // two nodes of the surface that meet, or one and the plane (a == b)
  int a, b;
  double gap, area;
  double even, odd;     // slip along y is even * u_y(a) - odd * u_y(b)
  bool touching = false;
  double slip[2] = {0, 0};
};

}  // namespace

int main(int argc, char **argv) {
  std::map<std::string, std::string> given;
  for (int n = 1; n < argc; ++n) {
    std::string s = argv[n];
    size_t eq = s.find('=');
    if (eq == std::string::npos) return std::fprintf(stderr, "not name=value: %s\n", argv[n]), 2;
    given[s.substr(0, eq)] = s.substr(eq + 1);
  }
  auto text = [&](const char *name) {
    if (!given.count(name)) std::fprintf(stderr, "missing: %s\n", name), std::exit(2);
    return given[name];
  };
  auto number = [&](const char *name) { return std::atof(text(name).c_str()); };
  const bool mirror = text("contact") == "mirror";
  const double nu = number("nu"), mu = number("mu"), x_in = number("x");
  const double a_max = number("radius"), extent = number("extent");
  const double contact_time = number("contact_time");  // expected; sets the size of a step only
  const int across = number("across"), steps = number("steps");
  const double pushed = number("pushed");  // > 0: this constant speed sideways, contact stuck
  const std::string history_file = text("history");

  Material mat;
  mat.young = 1 - nu * nu;  // E* = 1
  mat.shear = mat.young / (2 * (1 + nu));
  mat.lame = mat.young * nu / ((1 + nu) * (1 - 2 * nu));
  mat.yield = number("yield"), mat.hardening = number("hardening") * mat.young;

  Mesh mesh;
  {
    double h = a_max / across, ratio = 1.3, end = extent * a_max;
    Array half = graded(h, std::lround(1.15 * across), ratio, end);
    for (size_t n = half.size() - 1; n > 0; --n) mesh.x.push_back(-half[n]);
    mesh.x.insert(mesh.x.end(), half.begin(), half.end());
    mesh.y = half;
    mesh.z = graded(h, std::lround(0.7 * across), ratio, end);
  }
  mesh.build(text("element") == "b_bar", mat);
  const int nodes = mesh.nodes;

  // Free degrees of freedom; the others are given: u_y = 0 at y = 0, and the outer boundary.
  Array free_[3];
  for (auto &a : free_) a.assign(nodes, 0);
  struct Outer { int node; double normal[3], tangential[3]; };
  std::vector<Outer> outer;
  for (int k = 0; k <= mesh.ez; ++k)
    for (int j = 0; j <= mesh.ey; ++j)
      for (int i = 0; i <= mesh.ex; ++i) {
        int n = mesh.node(i, j, k);
        if (i == 0 || i == mesh.ex || j == mesh.ey || k == mesh.ez) {
          Outer o{n, {}, {}};
          boussinesq(nu, mat.shear, mesh.x[i], mesh.y[j], mesh.z[k], o.normal);
          cerruti(nu, mat.shear, mesh.x[i], mesh.y[j], mesh.z[k], o.tangential);
          outer.push_back(o);
        } else {
          free_[0][n] = free_[2][n] = 1;
          free_[1][n] = j > 0;
        }
      }

  // Masses: in proportion to a bound of the stiffness that pulls at the node in that direction,
  // then scaled so that the highest frequency (power iteration) stays below what a step bears.
  Array mass[3], inverse[3];
  for (int c = 0; c < 3; ++c) mass[c].assign(nodes, 0), inverse[c].assign(nodes, 0);
  for (int k = 0; k < mesh.ez; ++k)
    for (int j = 0; j < mesh.ey; ++j)
      for (int i = 0; i < mesh.ex; ++i) {
        double h[3] = {mesh.width[i], mesh.y[j + 1] - mesh.y[j], mesh.z[k + 1] - mesh.z[k]};
        double volume = h[0] * h[1] * h[2];
        for (int c = 0; c < 3; ++c) {
          double m = 0;
          for (int b = 0; b < 3; ++b)
            m += volume * (b == c ? mat.lame + 2 * mat.shear : mat.shear) / (h[b] * h[b]);
          for (int n = 0; n < 8; ++n)
            mass[c][mesh.node(i + (n & 1), j + (n >> 1 & 1), k + (n >> 2))] += m;
        }
      }
  {
    double top = 0;
    unsigned seed = 1;
    for (int c = 0; c < 3; ++c)
      for (int n = 0; n < nodes; ++n)
        mesh.v[c][n] = free_[c][n] * ((seed = seed * 1664525u + 1013904223u) / 4294967296.0 - 0.5);
    for (int it = 0; it < 60; ++it) {
      mesh.clear();
      for (auto &m : mesh.state) m = 0;
      for (size_t b = 0; b < mesh.state.size(); b += W * mesh.per_element)  // elastic: no yielding
        for (int g = 0; g < (mesh.full ? 8 : 1); ++g)
          for (int l = 0; l < W; ++l) mesh.state[b + W * (mesh.full ? 7 * g + 6 : 18) + l] = 1e100;
      for (auto &f : mesh.f) std::fill(f.begin(), f.end(), 0);
      mesh.step_elements();
      double vv = 0, ff = 0;
      for (int c = 0; c < 3; ++c)
        for (int n = 0; n < nodes; ++n)
          if (free_[c][n]) {
            double w = -mesh.f[c][n] / mass[c][n];
            vv += mesh.v[c][n] * mesh.v[c][n], ff += w * w;
            mesh.v[c][n] = w;
          }
      top = std::sqrt(ff / vv);
      for (auto &v : mesh.v) for (double &q : v) q /= std::sqrt(ff);
    }
    double highest = 1.7;  // of 2, in radians per step
    for (int c = 0; c < 3; ++c)
      for (int n = 0; n < nodes; ++n) {
        mass[c][n] *= free_[c][n] * top / (highest * highest);
        if (free_[c][n]) inverse[c][n] = 1 / mass[c][n];
      }
    mesh.clear();
    for (int c = 0; c < 3; ++c)
      std::fill(mesh.v[c].begin(), mesh.v[c].end(), 0), std::fill(mesh.f[c].begin(), mesh.f[c].end(), 0);
  }

  // Surface nodes that may touch.
  std::vector<Pair> pairs;
  for (int j = 0; mesh.y[j] < 1.6 * a_max; ++j)
    for (int i = mirror ? mesh.ex / 2 : 0; i <= mesh.ex; ++i) {
      if (std::fabs(mesh.x[i]) > 1.6 * a_max) continue;
      Pair p;
      p.a = mesh.node(i, j, 0), p.b = mirror ? mesh.node(mesh.ex - i, j, 0) : p.a;
      p.gap = (mesh.x[i] * mesh.x[i] + mesh.y[j] * mesh.y[j]) / 2;
      p.area = (p.a == p.b ? 1 : 2) * (mesh.x[i + 1] - mesh.x[i - 1]) / 2
               * (j ? (mesh.y[j + 1] - mesh.y[j - 1]) / 2 : mesh.y[1] / 2);
      p.even = mirror ? 0.5 : 1, p.odd = mirror ? 0.5 : 0;
      pairs.push_back(p);
    }

  const double m2 = 1, m1 = m2 / 3.5;
  const double v0 = std::sqrt(16 / 15.0);   // so that D = 1 were the elastic maximum
  const double dt = contact_time / v0 / steps;
  double v2 = v0, v1 = pushed > 0 ? pushed * v0 : x_in * mu * v0;
  const double start = m2 * v2 * v2 / 2, start_tangential = m1 * v1 * v1 / 2;
  double D = 0, U = 0, P = 0, T = 0;
  double smooth_P = 0, smooth_T = 0, damped = 0, rubbed = 0, through_boundary = 0;
  double D_max = 0, P_max = 0, radius_max = 0, push_work = 0;
  // Damping acts on what is faster than the mean of some `memory` steps: oscillations of the
  // mesh lose energy, the slow motion of the impact does not.
  const double damping = 0.1, memory = 20, boundary_memory = 10;
  Array mean_v[3], u[3];
  for (int c = 0; c < 3; ++c) mean_v[c].assign(nodes, 0), u[c].assign(nodes, 0);

  FILE *history = history_file == "none" ? nullptr : std::fopen(history_file.c_str(), "w");
  if (history) std::fprintf(history, "time,approach,sideways,normal_force,tangential_force,contact_radius\n");
  const int every = std::max(1, steps / 200);
  int step = 0, quiet = 0;
  for (; step < 6 * steps && quiet < 40; ++step) {
    // The contact forces of this step are not known yet, so those of the last one lead the motion.
    D += (v2 - P / m2 * dt) * dt, U += (v1 + (pushed > 0 ? 0 : T / m1 * dt)) * dt;
    for (int c = 0; c < 3; ++c) {
      double *v = mesh.v[c].data(), *f = mesh.f[c].data(), *s = mean_v[c].data();
      const double *im = inverse[c].data(), *m = mass[c].data();
      double lost = 0;
      for (int n = 0; n < nodes; ++n) {
        double fast = v[n] - s[n];
        double now = v[n] + f[n] * im[n] - damping * fast;
        lost += m[n] * fast * v[n];
        s[n] += fast / memory;
        v[n] = now;
      }
      damped += lost * damping;
    }
    double dP = (P - smooth_P) / boundary_memory, dT = (T - smooth_T) / boundary_memory;
    smooth_P += dP, smooth_T += dT;
    for (const Outer &o : outer)
      for (int c = 0; c < 3; ++c) {
        mesh.v[c][o.node] = dP * o.normal[c] + dT * o.tangential[c];
        through_boundary -= mesh.f[c][o.node] * mesh.v[c][o.node];
      }
    // Contact: bring nodes that would penetrate to the plane, hold or drag them along it.
    double normal = 0, tangential = 0, area = 0;
    double *vx = mesh.v[0].data(), *vy = mesh.v[1].data(), *vz = mesh.v[2].data();
    for (Pair &p : pairs) {
      int a = p.a, b = p.b;
      double both = a == b ? 1 : 2;
      double push = D - p.gap - 0.5 * (u[2][a] + vz[a] + u[2][b] + vz[b]);
      if (push <= 0) { p.touching = false; continue; }
      double slip[2] = {U + 0.5 * (u[0][a] + vx[a] + u[0][b] + vx[b]),
                        p.even * (u[1][a] + vy[a]) - p.odd * (u[1][b] + vy[b])};
      if (!p.touching) p.slip[0] = slip[0], p.slip[1] = slip[1], p.touching = true;
      double force = mass[2][a] * push;
      double t[2] = {mass[0][a] * (p.slip[0] - slip[0]), mass[1][a] * (p.slip[1] - slip[1])};
      double size = std::hypot(t[0], t[1]);
      if (pushed <= 0 && size > mu * force) {
        double scale = mu * force / size;
        for (int c = 0; c < 2; ++c) {
          t[c] *= scale;
          double now = slip[c] + t[c] * inverse[c][a];
          rubbed -= both * t[c] * (now - p.slip[c]);
          p.slip[c] = now;
        }
      }
      double px = t[0] * inverse[0][a], py = t[1] * inverse[1][a];
      vz[a] += push, vx[a] += px, vy[a] += py;
      if (a != b) vz[b] += push, vx[b] += px, vy[b] -= py;
      normal += both * force, tangential += both * t[0], area += p.area;
    }
    for (int c = 0; c < 3; ++c) {
      double *v = mesh.v[c].data(), *w = u[c].data();
      for (int n = 0; n < mesh.row * (mesh.ey + 1); ++n) w[n] += v[n];  // the surface's are needed
      std::fill(mesh.f[c].begin(), mesh.f[c].end(), 0);
    }
    mesh.step_elements();
    // Both halves y > 0 and y < 0.
    P = 2 * normal, T = 2 * tangential;
    v2 -= P / m2 * dt;
    if (pushed > 0) push_work -= T * v1 * dt;
    else v1 += T / m1 * dt;
    double radius = std::sqrt(2 * area / M_PI);
    D_max = std::max(D_max, D), P_max = std::max(P_max, P), radius_max = std::max(radius_max, radius);
    quiet = P > 0 || v2 > 0 ? 0 : quiet + 1;
    if (history && (step % every == 0 || quiet == 40))
      std::fprintf(history, "%.8g,%.8g,%.8g,%.8g,%.8g,%.6g\n", (step + 1) * dt * v0, D, U, P, -T, radius);
    if (!(std::fabs(v2) < 10 * v0)) return std::fprintf(stderr, "unstable\n"), 1;
  }
  if (history) std::fclose(history);

  double lost = start + start_tangential - m2 * v2 * v2 / 2 - m1 * v1 * v1 / 2 + push_work;
  double plastic = 2 * mesh.plastic, friction = 2 * rubbed, residual = 2 * mesh.stored();
  double delta_y = std::pow(M_PI * 1.6 * mat.yield / 2, 2);
  std::printf("restitution,%.8g\n", -v2 / v0);
  std::printf("velocity,%.8g\n", pushed > 0 || mu == 0 ? 0.0 : v1 / (mu * v0));
  std::printf("contact_time,%.8g\n", (step - 40) * dt * v0);
  std::printf("radius,%.8g\n", radius_max);
  std::printf("approach,%.8g\n", D_max);
  std::printf("force,%.8g\n", P_max);
  std::printf("over_yield,%.8g\n", D_max / delta_y);
  // Energies over that of the normal motion before the impact.
  std::printf("plastic,%.8g\n", plastic / start);
  std::printf("friction,%.8g\n", friction / start);
  std::printf("damping,%.8g\n", 2 * damped / start);
  std::printf("residual,%.8g\n", residual / start);
  std::printf("boundary,%.8g\n", 2 * through_boundary / start);
  std::printf("defect,%.8g\n",
              (lost - plastic - friction - 2 * damped - residual + 2 * through_boundary) / start);
  return 0;
}
