// Asterisms of four stars, hashed by their shape, to find where in the sky four points of a picture may be.
//
// The method is that of Astrometry.net (Lang, Hogg, Mierle, Blanton and Roweis, Astronomical Journal 139,
// 2010, 1782): the two stars farthest apart, A and B, are put at 0 and 1 of the complex plane; the places of
// the others, C and D, are the asterism's code of four numbers, which does not depend on place, rotation and
// size. Here the asterism lies on the sphere and is projected stereographically about its own middle, so that
// one code serves asterisms from 3 to 100 degrees; a picture's points become directions by an assumed lens
// (star_recognition.h). The stars of an asterism are neighbours among the N brightest of the sky, for several
// N: pictures with few stars show the large asterisms of the bright ones.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace vegard::fit {

/// The number of the brightest stars of which the sky's asterisms are made.
inline constexpr int kFigureStars = 950;

/// The indices of the four members in the order A, B, C, D.
using AsterismMembers = std::array<int, 4>;

struct Asterism {
  AsterismMembers members{};
  std::array<double, 4> code{};  ///< x and y of C, x and y of D, where A is at (0, 0) and B at (1, 0)
  double size_rad = 0.0;         ///< angle from A to B
};

/// Makes the asterism of four directions of length 1, with its members in order: the sum of x of C and D is
/// at most 1, and x of C at most that of D. Returns false if two of them coincide or they do not fit into a
/// hemisphere.
bool make_asterism(const std::vector<Eigen::Vector3d>& directions, const AsterismMembers& members,
                   Asterism& asterism);

/// Returns the asterism in every order that it may have if its code has errors up to `tolerance`; itself
/// first.
std::vector<Asterism> orders_of(const Asterism& asterism, double tolerance);

/// Returns sets of four of the first `first` places: a point and three of its `neighbours` nearest neighbours
/// among them; every set once, in a fixed order.
std::vector<AsterismMembers> neighbour_sets(const std::vector<Eigen::Vector3d>& places, int first,
                                            int neighbours);

/// The sky's asterisms by their codes.
class AsterismIndex {
 public:
  /// `stars`: directions, the brightest first. The members of an asterism are a star and three of its
  /// `neighbours` nearest neighbours among the first so many stars, for each of `levels`.
  AsterismIndex(const std::vector<Eigen::Vector3d>& stars, const std::vector<int>& levels, int neighbours);

  /// Appends to `found` the asterisms whose code is within `tolerance` of this one's (a distance in four
  /// dimensions) and whose size is within a factor `size_factor`.
  void find(const Asterism& like, double tolerance, double size_factor,
            std::vector<const Asterism*>& found) const;

  std::size_t size() const { return asterisms_.size(); }

 private:
  static std::array<int, 4> cell_of(const std::array<double, 4>& code);
  static std::size_t number_of(const std::array<int, 4>& cell);
  std::vector<Asterism> asterisms_;   // in the order of their cells
  std::vector<double> sizes_rad_;     // of each: most are told apart by it, without the rest
  std::vector<std::uint32_t> begin_;  // of each cell
};

/// Returns the index of data/stars at J2000, with bright_stars() in their order.
const AsterismIndex& bright_star_asterisms();

/// Returns that of the small asterisms of all sim::deep_stars(), for fields of 3 to 30 degrees.
const AsterismIndex& deep_star_asterisms();

}  // namespace vegard::fit
