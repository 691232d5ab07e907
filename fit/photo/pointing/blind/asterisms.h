// Figures of four stars, hashed by their shape: where in the sky may four points of a picture be?
//
// As Astrometry.net does it (Lang, Hogg, Mierle, Blanton and Roweis, Astronomical Journal 139, 2010, 1782):
// the two stars farthest apart, A and B, are put at 0 and 1 of the complex plane; the places of the others, C
// and D, are the figure's code of four numbers, which neither place, turn nor size changes. Here the figure
// is drawn on the sphere, projected stereographically about its own middle, so that one code serves figures
// from 3 to 100 degrees; a picture's points become directions by an assumed lens (star_recognition.h). The
// stars of a figure are neighbours among the N brightest of the sky, for several N: pictures that show few
// stars have the large figures of the bright ones.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace vegard::fit {

/// Four members in the order A, B, C, D, by whoever numbered them.
using AsterismMembers = std::array<int, 4>;

struct Asterism {
  AsterismMembers members{};
  std::array<double, 4> code{};  ///< x and y of C, x and y of D, where A is at (0, 0) and B at (1, 0)
  double size_rad = 0.0;         ///< angle from A to B
};

/// The figure of four directions of length 1, its members put in order: x of C and D together at most 1, and
/// x of C at most that of D. False if two of them coincide or they do not fit into a hemisphere.
bool make_asterism(const std::vector<Eigen::Vector3d>& directions, const AsterismMembers& members,
                   Asterism& asterism);

/// The same figure in every order that errors of the code by `tolerance` may have made of it; itself first.
std::vector<Asterism> orders_of(const Asterism& asterism, double tolerance);

/// Sets of four of `places`, each a point and three of its `neighbours` nearest (by squared distance) among
/// the first `first` of them; every set once, in a fixed order.
std::vector<AsterismMembers> neighbour_sets(const std::vector<Eigen::Vector3d>& places, int first,
                                            int neighbours);

/// The sky's figures by their codes.
class AsterismIndex {
 public:
  /// `stars`: directions, the brightest first.
  explicit AsterismIndex(const std::vector<Eigen::Vector3d>& stars);

  /// Figures whose code is within `tolerance` of this one's (as a distance of four dimensions) and whose size
  /// is within a factor `size_factor`. Appended to `found`.
  void find(const Asterism& like, double tolerance, double size_factor,
            std::vector<const Asterism*>& found) const;

  std::size_t size() const { return asterisms_.size(); }

 private:
  static std::array<int, 4> cell_of(const std::array<double, 4>& code);
  static std::size_t number_of(const std::array<int, 4>& cell);
  std::vector<Asterism> asterisms_;   // in the order of their cells
  std::vector<std::uint32_t> begin_;  // of each cell
};

/// The index of data/stars at J2000: bright_stars() in their order.
const AsterismIndex& bright_star_asterisms();

}  // namespace vegard::fit
