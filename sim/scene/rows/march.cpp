// [march]: how volumes are marched and how they meet what else is in the picture.
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace {

template <class Value>
Row<March> row(const char* key, Value March::*value) {
  return Row("march", key, &Scene::march, value);
}

}  // namespace

std::vector<Declaration> march_rows() {
  // clang-format off
  return {
      row("step_km", &March::step_km).in("km").within(0.01, 100).means("step along a ray through aurora by its footprint"),
      row("step_cells", &March::step_cells).within(0.1, 100).means("largest step across a footprint, in its cells"),
      row("skip", &March::skip).means("skip empty space"),
      row("ghosts", &March::ghosts).one_of<GhostRule>({{"span", GhostRule::span}, {"literal", GhostRule::literal}})
          .means("rays from the camera; or both ways with the source's rule, which loses the near half of the Earth"),
      row("depth", &March::depth).names_file().means("depth picture of the camera's size, relative to the scene's file; empty: none"),
      row("depth_is", &March::depth_is).one_of<DepthMeaning>({{"distance", DepthMeaning::distance}, {"forward", DepthMeaning::forward}, {"log", DepthMeaning::log}})
          .means("depth along the ray, along the camera's axis, or its logarithm (as the source)"),
      row("depth_gain", &March::depth_gain).in("km").within(1e-9, 1e9).means("kilometres to a unit of that picture"),
      row("depth_far_km", &March::depth_far_km).in("km").within(1e-3, 1e12).means("distance of a logarithmic depth of 1"),
      row("blend", &March::blend).one_of<BlendRule>({{"alpha", BlendRule::alpha}, {"add", BlendRule::add}})
          .means("volumes absorb what is behind them, or are only added"),
      row("shrink", &March::shrink).within(1, 16).means("one of so many pixels across and down is marched, others are interpolated"),
      row("smooth_px", &March::smooth_px).in("px").within(0, 100).means("standard deviation of a blur of the marched light, against grain"),
      row("glow", &March::glow).within(0, 1).means("share of the volumes' light that glows"),
      row("glow_deg", &March::glow_deg).in("deg").within(0.001, 45).means("standard deviation of the glow"),
  };
  // clang-format on
}

}  // namespace vegard::sim
