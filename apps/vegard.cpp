#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>

#include "apps/animate.h"
#include "apps/brightness.h"
#include "apps/calibrate.h"
#include "apps/command_line.h"
#include "apps/compare.h"
#include "apps/describe.h"
#include "apps/directions.h"
#include "apps/exit_code.h"
#include "apps/fit.h"
#include "apps/grid.h"
#include "apps/horizon.h"
#include "apps/keogram.h"
#include "apps/linearise.h"
#include "apps/lines.h"
#include "apps/mask.h"
#include "apps/params.h"
#include "apps/points.h"
#include "apps/preview.h"
#include "apps/profile.h"
#include "apps/render.h"
#include "apps/sdf.h"
#include "apps/sequence.h"
#include "apps/slices.h"
#include "apps/volume.h"
#include "fit/version.h"
#include "sim/base/error.h"
#include "sim/base/grid/vdb_io.h"
#include "sim/base/picture/fits_io.h"
#include "sim/base/picture/image_io.h"
#include "sim/base/version.h"

namespace {

using namespace vegard;

std::string versions() {
  return "vegard " + sim::version() + "\nCeres " + fit::ceres_version() + "\nOpenCV " +
         fit::opencv_version() + "\nEigen " + sim::eigen_version() + "\nOpenImageIO " +
         sim::image_library_version() + "\nCFITSIO " + sim::fits_library_version() + "\nOpenVDB " +
         sim::vdb_library_version();
}

int report(const std::string& message, int exit_code) {
  std::fprintf(stderr, "vegard: %s\n", message.c_str());
  return exit_code;
}

int run(int argc, char** argv) {
  CLI::App app("Simulates aurorae and fits them to photographs.", "vegard");
  app.set_version_flag("--version", versions, "Print the versions of vegard and of its libraries");
  int exit_code = apps::good;
  apps::add_render_command(app, exit_code);
  apps::add_animate_command(app, exit_code);
  apps::add_preview_command(app, exit_code);
  apps::add_points_command(app, exit_code);
  apps::add_volume_command(app, exit_code);
  apps::add_describe_command(app, exit_code);
  apps::add_horizon_command(app, exit_code);
  apps::add_profile_command(app, exit_code);
  apps::add_keogram_command(app, exit_code);
  apps::add_directions_command(app, exit_code);
  apps::add_mask_command(app, exit_code);
  apps::add_brightness_command(app, exit_code);
  apps::add_calibrate_command(app, exit_code);
  apps::add_fit_command(app, exit_code, apps::command_line(argc, argv));
  apps::add_compare_command(app, exit_code);
  apps::add_sequence_command(app, exit_code, apps::command_line(argc, argv));
  apps::add_grid_command(app, exit_code);
  apps::add_slices_command(app, exit_code);
  apps::add_sdf_command(app, exit_code);
  apps::add_linearise_command(app, exit_code);
  apps::add_params_command(app, exit_code);
  apps::add_lines_command(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version come this way too, as good ends.
    if (error.get_exit_code() == 0) return app.exit(error);
    return report(std::string(error.what()) + " (see vegard --help)", apps::bad_usage);
  }
  // CLI11's own require_subcommand would hide a misspelt subcommand behind "a subcommand is required".
  if (app.get_subcommands().empty()) return report("which subcommand? (see vegard --help)", apps::bad_usage);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  // A write past the file size limit is to fail as on a full disk, not to kill the process.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const sim::Error& error) {
    return report(error.what(), apps::exit_code_of(error.kind()));
  } catch (const std::exception& error) {
    return report(std::string("internal error: ") + error.what(), apps::internal_error);
  }
}
