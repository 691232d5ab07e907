// [sensor]: from light to numbers.
#include "sim/scene/rows/row.h"
#include "sim/scene/rows/rows.h"

namespace vegard::sim {
std::vector<Declaration> sensor_rows() {
  // clang-format off
  return {
      Row("sensor", "primaries", &Scene::sensor, &Sensor::primaries).one_of({"srgb", "smpte-c"})
          .means("colour primaries of the image"),
      Row("sensor", "gain_per_kilorayleigh", &Scene::sensor, &Sensor::gain_per_kilorayleigh).within(1e-12, 1e12)
          .means("linear sensor value (white = 1) of the luminance of 1 kR of 557.7 nm"),
  };
  // clang-format on
}

}  // namespace vegard::sim
