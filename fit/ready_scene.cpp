#include "fit/ready_scene.h"

#include "sim/light/sheet_profile.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/scene/table/table_files.h"
#include "sim/view/colour/sensor_response.h"

namespace vegard::fit {

void make_ready(sim::Scene& scene) {
  sim::validate(scene);
  sim::read_table_files(scene);
  sim::check_profiles(scene);
  sim::limit_free_oxygen(scene);
  sim::SensorResponse check_of_the_response(scene);
}

}  // namespace vegard::fit
