#include "sim/emit/footprint/map/curve.h"

#include <gtest/gtest.h>

namespace vegard::sim::curve_test {
namespace {

using Point = CurveNode<double, 2>;
using Piece = CurvePiece<double, 2>;

Point at(double east, double north, double flux = 1.0) { return {{east, north}, flux, 0.0}; }

double length(const CurvePieces<double, 2>& curve) {
  double sum = 0.0;
  for (const Piece& piece : curve.pieces) sum += piece.length;
  return sum;
}

TEST(Curve, OfTwoPointsIsTheLineBetweenThem) {
  const auto curve = curve_pieces<double, 2>({at(0.0, 0.0, 1.0), at(30.0, 40.0, 3.0)}, false, 1.0, false);
  EXPECT_NEAR(length(curve), 50.0, 1e-12);
  for (const Piece& piece : curve.pieces) {
    EXPECT_NEAR(piece.middle.at[0] * 4.0, piece.middle.at[1] * 3.0, 1e-12);
    EXPECT_NEAR(piece.middle.flux, 1.0 + 2.0 * piece.middle.at[0] / 30.0, 1e-12);
    EXPECT_LE(piece.length, 1.0);
  }
}

TEST(Curve, PassesThroughItsPointsWithoutABend) {
  const std::vector<Point> points = {at(0, 0), at(100, 80), at(120, -40), at(400, 0), at(405, 30)};
  const auto curve = curve_pieces<double, 2>(points, false, 0.1, false);
  for (const Point& point : points) {
    double nearest = 1e9;
    for (const Piece& piece : curve.pieces)
      nearest =
          std::min(nearest, std::hypot(piece.middle.at[0] - point.at[0], piece.middle.at[1] - point.at[1]));
    // The nearest middle of a piece is half a piece away at most; the speed is uneven.
    EXPECT_LT(nearest, 0.1);
  }
  const std::vector<Piece>& pieces = curve.pieces;
  // Directions of one piece and the next differ by the curvature, which is below 1 / 0.5 km even where the
  // points are 30 km apart, times a tenth of a kilometre.
  for (std::size_t i = 2; i < pieces.size(); ++i) {
    const auto direction = [&](std::size_t k) {
      return std::atan2(pieces[k].middle.at[1] - pieces[k - 1].middle.at[1],
                        pieces[k].middle.at[0] - pieces[k - 1].middle.at[0]);
    };
    EXPECT_LT(std::abs(std::remainder(direction(i) - direction(i - 1), 2.0 * M_PI)), 0.2);
  }
}

TEST(Curve, ThroughPointsOfACircleIsNearlyThatCircle) {
  std::vector<Point> points;
  for (int i = 0; i < 16; ++i)
    points.push_back(at(100.0 * std::cos(M_PI * i / 8.0), 100.0 * std::sin(M_PI * i / 8.0)));
  const auto curve = curve_pieces<double, 2>(points, true, 1.0, false);
  // Between points pi/8 apart the tangents' parabolas miss the circle by some (pi/8)^4 / 40.
  EXPECT_NEAR(length(curve), 200.0 * M_PI, 200.0 * M_PI * 1e-3);
  for (const Piece& piece : curve.pieces)
    EXPECT_NEAR(std::hypot(piece.middle.at[0], piece.middle.at[1]), 100.0, 0.1);
}

TEST(Curve, LeavesOutPointsThatStandTwice) {
  const auto once = curve_pieces<double, 2>({at(0, 0), at(10, 5), at(20, 0)}, false, 1.0, false);
  const auto twice = curve_pieces<double, 2>({at(0, 0), at(10, 5), at(10, 5), at(20, 0)}, false, 1.0, false);
  EXPECT_EQ(length(once), length(twice));
  EXPECT_TRUE((curve_pieces<double, 2>({at(3, 3), at(3, 3)}, true, 1.0, false).pieces.empty()));
}

TEST(Curve, OfTwoPlacesIsNotClosed) {
  const auto two = curve_pieces<double, 2>({at(0, 0), at(10, 5), at(0, 0)}, true, 1.0, false);
  EXPECT_FALSE(two.is_closed);
  EXPECT_NEAR(length(two), std::hypot(10.0, 5.0), 1e-12);
  EXPECT_TRUE((curve_pieces<double, 2>({at(0, 0), at(10, 5), at(0, 9)}, true, 1.0, false).is_closed));
}

TEST(Curve, OnASphereKeepsToItAndKnowsItsLength) {
  std::vector<CurveNode<double, 3>> points;
  const double ring = 0.4, height = std::sqrt(1.0 - ring * ring);
  for (int i = 0; i < 24; ++i)
    points.push_back(
        {{ring * std::cos(M_PI * i / 12.0), ring * std::sin(M_PI * i / 12.0), height}, 1.0, 0.0});
  double sum = 0.0;
  for (const auto& piece : curve_pieces<double, 3>(points, true, 0.01, true).pieces) {
    EXPECT_NEAR(length_of(piece.middle.at), 1.0, 1e-12);
    sum += piece.length;
  }
  EXPECT_NEAR(sum, 2.0 * M_PI * ring, 2.0 * M_PI * ring * 1e-3);
}

}  // namespace
}  // namespace vegard::sim::curve_test
