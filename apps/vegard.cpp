#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"
#include "fit/survey/sqlite_file.h"
#include "fit/version.h"
#include "sim/base/error.h"
#include "sim/base/grid/vdb_io.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/processor.h"
#include "sim/base/version.h"

namespace {

using namespace vegard;

std::string versions() {
  return "vegard " + sim::version() + "\nCeres " + fit::ceres_version() + "\nOpenCV " +
         fit::opencv_version() + "\nEigen " + sim::eigen_version() + "\nOpenImageIO " +
         sim::image_library_version() + "\nCFITSIO " + sim::fits_library_version() + "\nOpenVDB " +
         sim::vdb_library_version() + "\nSQLite " + fit::sqlite_version();
}

int report(const std::string& message, int exit_code) {
  apps::complain("vegard", message);
  return exit_code;
}

int run(int argc, char** argv) {
  apps::Program program("vegard", "Simulates aurorae and fits them to photographs.", versions, argc, argv);
  program.begin_group("From a photograph to numbers");
  apps::add_measure_command(program);
  apps::add_fit_command(program);
  apps::add_compare_command(program);
  apps::add_map_command(program);
  apps::add_border_command(program);
  apps::add_profile_command(program);
  apps::add_keogram_command(program);
  apps::add_sequence_command(program);
  apps::add_survey_command(program);
  program.begin_group("Cameras and pictures");
  apps::add_describe_command(program);
  apps::add_calibrate_command(program);
  apps::add_horizon_command(program);
  apps::add_directions_command(program);
  apps::add_mask_command(program);
  apps::add_linearise_command(program);
  apps::add_photometry_command(program);
  program.begin_group("Render a scene");
  apps::add_render_command(program);
  apps::add_animate_command(program);
  apps::add_preview_command(program);
  apps::add_brightness_command(program);
  apps::add_points_command(program);
  apps::add_volume_command(program);
  apps::add_grid_command(program);
  apps::add_slices_command(program);
  apps::add_sdf_command(program);
  program.begin_group("Electrons, air and lines");
  apps::add_invert_command(program);
  apps::add_electrons_command(program);
  apps::add_atmosphere_command(program);
  apps::add_tables_command(program);
  apps::add_lines_command(program);
  apps::add_bodies_command(program);
  program.begin_group("Files for other programs");
  apps::add_to_netcdf_command(program);
  apps::add_to_gemini_command(program);
  apps::add_to_lompe_command(program);
  program.begin_group("Reference");
  apps::add_params_command(program);
  apps::add_manual_command(program);
  const int exit_code = program.run();
  return exit_code == apps::interrupted ? apps::exit_code_of_interruption() : exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  // A write past the file size limit is to fail as on a full disk, not to kill the process.
  std::signal(SIGXFSZ, SIG_IGN);
  apps::replace_closed_streams();
  try {
    sim::check_processor();
    const int exit_code = run(argc, argv);
    apps::finish_output();
    return exit_code;
  } catch (const sim::Error& error) {
    return report(error.what(), apps::exit_code_of(error.kind()));
  } catch (const apps::OutOfMemory& error) {
    return report(error.what(), apps::internal_error);
  } catch (const std::bad_alloc&) {
    return report("there is not enough memory to begin", apps::internal_error);
  } catch (const std::exception& error) {
    return report(std::string("internal error: ") + error.what(), apps::internal_error);
  }
}
