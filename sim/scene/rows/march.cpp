// [march]: how volumes are marched and how they meet what else is in the picture.
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"

namespace vegard::sim {
namespace {

template <class Value>
Row row(const char* key, Value March::*value) {
  return Row("march", key, &Scene::march, value);
}

}  // namespace

std::vector<Declaration> march_rows() {
  // clang-format off
  return {
      row("step_km", &March::step_km).in("km").within(0.01, 100).means("step along a ray through aurora by its footprint"),
      row("step_cells", &March::step_cells).within(0.1, 100).means("cells of a footprint that a step moves the foot by, at most"),
      row("skip", &March::skip).means("pass over empty space by the distance to the footprint"),
      row("ghosts", &March::ghosts).one_of<GhostRule>({{"span", GhostRule::span}, {"literal", GhostRule::literal}})
          .means("rays begin at the camera; or run both ways with the source's rule against ghosts, which loses the near half of the Earth seen from orbit"),
      row("depth", &March::depth).names_file().means("picture of the distance to what stands in the scene, of the camera's size, beside the scene's file; empty: none"),
      row("depth_is", &March::depth_is).one_of<DepthMeaning>({{"distance", DepthMeaning::distance}, {"forward", DepthMeaning::forward}, {"log", DepthMeaning::log}})
          .means("along the ray; or along the camera's axis; or the source's logarithmic depth of the latter"),
      row("depth_gain", &March::depth_gain).in("km").within(1e-9, 1e9).means("kilometres to a unit of that picture"),
      row("depth_far_km", &March::depth_far_km).in("km").within(1e-3, 1e12).means("distance of a logarithmic depth of 1"),
      row("blend", &March::blend).one_of<BlendRule>({{"alpha", BlendRule::alpha}, {"add", BlendRule::add}})
          .means("volumes hide what is behind them as far as they absorb, or are only added to it"),
      row("shrink", &March::shrink).within(1, 16).means("of so many pixels across and down one is marched, the others follow it by depth"),
      row("smooth_px", &March::smooth_px).in("px").within(0, 100).means("blur of what was marched, standard deviation, to hide grain"),
      row("glow", &March::glow).within(0, 1).means("share of the volumes' light that is spread about"),
      row("glow_deg", &March::glow_deg).in("deg").within(0.001, 45).means("how far, standard deviation"),
  };
  // clang-format on
}

}  // namespace vegard::sim
