#include "sim/emit/sun/strand/strand.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vegard::sim {
namespace {

constexpr double kSagitta = 1.0 / 20.0;  ///< of the radius
constexpr double kTaper = 0.25;          ///< of the smaller radius
constexpr double kMaxParts = 400.0;      ///< of a piece, or of a chain for its taper
constexpr double kSame = 1e-9;           ///< of t

double bend(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) {
  double square = 0.0;
  for (int i = 0; i < 3; ++i) square += (a[i] - 2.0 * b[i] + c[i]) * (a[i] - 2.0 * b[i] + c[i]);
  return std::sqrt(square);
}

/// How many equal steps of u a piece needs.
template <class T>
double parts_of_piece(const Strand<T>& strand, int piece, double radius) {
  Vec3<double> p[4];
  for (int i = 0; i < 4; ++i) p[i] = values3(strand.points[3 * piece + i]);
  const double second = 6.0 * std::max(bend(p[0], p[1], p[2]), bend(p[1], p[2], p[3]));
  if (!(radius > 0.0)) return kMaxParts;
  return std::clamp(std::sqrt(second / (8.0 * kSagitta * radius)), 1.0, kMaxParts);
}

/// Returns the parameters that must have joints, in rising order: ends of pieces and numbers of `along`.
template <class T>
std::vector<double> fixed_joints(const Strand<T>& strand) {
  std::vector<double> t;
  const int pieces = strand.pieces(), steps = static_cast<int>(strand.along.size()) - 1;
  for (int i = 0; i <= pieces; ++i) t.push_back(static_cast<double>(i) / pieces);
  for (int k = 1; k < steps; ++k) t.push_back(static_cast<double>(k) / steps);
  std::sort(t.begin(), t.end());
  t.erase(std::unique(t.begin(), t.end(), [](double a, double b) { return b - a < kSame; }), t.end());
  return t;
}

template <class T>
StrandJoint<T> joint_at(const Strand<T>& strand, double t) {
  const int pieces = strand.pieces();
  const int piece = std::clamp(static_cast<int>(std::floor(t * pieces + kSame)), 0, pieces - 1);
  const double u = std::clamp(t * pieces - piece, 0.0, 1.0), v = 1.0 - u;
  const double weight[4] = {v * v * v, 3.0 * v * v * u, 3.0 * v * u * u, u * u * u};
  StrandJoint<T> joint;
  for (int axis = 0; axis < 3; ++axis) {
    joint.place[axis] = strand.points[3 * piece][axis] * weight[0];
    for (int i = 1; i < 4; ++i)
      joint.place[axis] = joint.place[axis] + strand.points[3 * piece + i][axis] * weight[i];
  }
  joint.radius = strand.radius_first * (1.0 - t) + strand.radius_last * t;
  const int steps = static_cast<int>(strand.along.size()) - 1;
  const int step = std::clamp(static_cast<int>(std::floor(t * steps + kSame)), 0, steps - 1);
  const double share = t * steps - step;
  joint.along = strand.along[step] * (1.0 - share) + strand.along[step + 1] * share;
  return joint;
}

/// Returns the unit vector from `a` to `b`, or `otherwise` if they are the same place.
template <class T>
Vec3<T> direction(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& otherwise) {
  const Vec3<T> way = minus3(b, a);
  return value_of(dot3(way, way)) > 0.0 ? unit3(way) : otherwise;
}

}  // namespace

template <class T>
void add_joints(const Strand<T>& strand, std::vector<StrandJoint<T>>& joints) {
  assert(strand.points.size() % 3 == 1 && strand.points.size() >= 4 && strand.along.size() >= 2);
  const double first = value_of(strand.radius_first), last = value_of(strand.radius_last);
  const double least = std::min(first, last);
  const double for_taper =
      least > 0.0 ? std::min(std::abs(last - first) / (kTaper * least), kMaxParts) : kMaxParts;
  const int pieces = strand.pieces();
  const std::size_t begin = joints.size();
  const std::vector<double> fixed = fixed_joints(strand);
  for (std::size_t k = 0; k + 1 < fixed.size(); ++k) {
    const double low = fixed[k], step = fixed[k + 1] - low;
    const int piece = std::clamp(static_cast<int>(std::floor(low * pieces + kSame)), 0, pieces - 1);
    const double radius = std::min(first + (last - first) * low, first + (last - first) * (low + step));
    const double wanted = step * std::max(pieces * parts_of_piece(strand, piece, radius), for_taper);
    const int parts = std::max(1, static_cast<int>(std::ceil(wanted - 0.1)));
    for (int i = 0; i < parts; ++i) joints.push_back(joint_at(strand, low + step * i / parts));
  }
  joints.push_back(joint_at(strand, 1.0));

  const std::size_t end = joints.size();
  Vec3<T> before = direction(joints[begin].place, joints[begin + 1].place, {T(0.0), T(0.0), T(1.0)});
  joints[begin].normal = direction(strand.points[0], strand.points[1], before);
  for (std::size_t j = begin + 1; j + 1 < end; ++j) {
    const Vec3<T> after = direction(joints[j].place, joints[j + 1].place, before);
    const Vec3<T> sum = along3(before, 1.0, after);
    // A strand that turns right back has no bisecting plane.
    joints[j].normal = value_of(dot3(sum, sum)) > 1e-6 ? unit3(sum) : before;
    before = after;
  }
  const std::size_t n = strand.points.size();
  joints[end - 1].normal = direction(strand.points[n - 2], strand.points[n - 1], before);
}

template void add_joints(const Strand<double>&, std::vector<StrandJoint<double>>&);
template void add_joints(const Strand<FreeDual>&, std::vector<StrandJoint<FreeDual>>&);

}  // namespace vegard::sim
