#include "sim/render/ready_scene.h"

#include "sim/light/emission_tables.h"
#include "sim/light/sheet_profile.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/table_files.h"
#include "sim/view/colour/sensor_response.h"

namespace vegard::sim {

void make_ready(Scene& scene) {
  validate(scene);
  read_table_files(scene);
  check_profiles(scene);
  limit_free_oxygen(scene);
  SensorResponse check_of_the_response(scene);
}

}  // namespace vegard::sim
