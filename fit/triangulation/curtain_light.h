// The light of two pictures along field lines through a border, which one of them shows, at a supposed
// height.
//
// The border is cut into pieces. Along each field line (IGRF-14, straight above its foot) the light is taken
// at equal steps of height, in the other picture where it may have moved to.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/triangulation/matched_curves.h"
#include "fit/triangulation/smooth_light.h"
#include "sim/light/field/igrf.h"

namespace vegard::fit {

inline constexpr std::size_t kBorderPieces = 16;
inline constexpr double kLowestAbove_km = -10.0;  ///< of the field lines, above the border
inline constexpr double kStepAbove_km = 2.5;

/// What is supposed of cameras, border, field and movement.
struct CurtainSupposition {
  const std::vector<ViewPoint>* cameras = nullptr;     ///< two
  const PictureCurve* border = nullptr;                ///< of one of them
  double highest_km = 45.0;                            ///< of the field lines, above the border
  double field_north_deg = 0.0, field_east_deg = 0.0;  ///< by which field lines lean, beside IGRF's
  double along_km = 0.0,
         across_km = 0.0;  ///< movement from the first picture to the second, along the base and to its left
};

struct BorderFieldLine {
  Eigen::Vector3d foot_km, rise;  ///< the place of the border; the field line, in km for each km of height
  std::size_t piece = 0;
};

class CurtainLight {
 public:
  /// `year`: decimal, of the field. Light below `lowest_elevation_deg` of a camera does not count. Photos
  /// must live longer.
  CurtainLight(const std::vector<ViewPoint>& cameras, const std::vector<const Photo*>& photos, int channel,
               double year, double lowest_elevation_deg);

  /// Level unit vectors along the base and to its left.
  void set_base(const Eigen::Vector3d& along, const Eigen::Vector3d& across);

  /// The border at a height: some hundred field lines, in their order along it.
  std::vector<BorderFieldLine> lines_at(const CurtainSupposition& supposed, double height_km) const;

  static std::size_t levels(double highest_km, double step_km = kStepAbove_km);

  /// The light of one camera along the lines, [line][level]; NaN low in the sky and outside of the picture.
  std::vector<double> along(const CurtainSupposition& supposed, const std::vector<BorderFieldLine>& lines,
                            std::size_t camera, double step_km = kStepAbove_km) const;

 private:
  double at(const ViewPoint& view, std::size_t camera, const Eigen::Vector3d& place_km) const;

  sim::Igrf igrf_;
  double least_sine_;
  std::vector<SmoothLight> light_;
  Eigen::Vector3d along_ = Eigen::Vector3d::Zero(), across_ = Eigen::Vector3d::Zero();
};

}  // namespace vegard::fit
