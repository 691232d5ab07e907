// The subcommands, each in a file of this folder with its options, its work and its exit code. A new one is
// declared and listed here, and nowhere else: the help, the manual pages and the completions follow.
#pragma once

#include <vector>

#include "apps/options/command.h"

namespace vegard::apps {

/// Adds a subcommand to the program, whose run() may throw sim::Error.
using AddCommand = void(Program& program);
AddCommand add_measure_command, add_fit_command, add_compare_command, add_map_command, add_border_command,
    add_profile_command, add_keogram_command, add_sequence_command, add_survey_command;
AddCommand add_describe_command, add_calibrate_command, add_horizon_command, add_directions_command,
    add_mask_command, add_linearise_command, add_photometry_command, add_triangulate_command;
AddCommand add_render_command, add_animate_command, add_preview_command, add_brightness_command,
    add_points_command, add_volume_command, add_grid_command, add_slices_command, add_sdf_command;
AddCommand add_studio_command;
AddCommand add_invert_command, add_electrons_command, add_atmosphere_command, add_tables_command,
    add_ionosphere_command, add_lines_command, add_bodies_command;
AddCommand add_export_command, add_track_command, add_to_netcdf_command, add_to_gemini_command,
    add_to_lompe_command;
AddCommand add_params_command, add_manual_command;

struct CommandGroup {
  const char* title;
  std::vector<AddCommand*> commands;
};

/// All subcommands, in the order of the help.
inline std::vector<CommandGroup> command_groups() {
  return {
      {"From a photograph to numbers",
       {add_studio_command, add_measure_command, add_fit_command, add_compare_command, add_map_command,
        add_border_command, add_profile_command, add_keogram_command, add_sequence_command,
        add_survey_command}},
      {"Cameras and pictures",
       {add_describe_command, add_calibrate_command, add_horizon_command, add_directions_command,
        add_mask_command, add_linearise_command, add_photometry_command, add_triangulate_command}},
      {"Render a scene",
       {add_render_command, add_animate_command, add_preview_command, add_brightness_command,
        add_points_command, add_volume_command, add_grid_command, add_slices_command, add_sdf_command}},
      {"Electrons, air and lines",
       {add_invert_command, add_electrons_command, add_atmosphere_command, add_ionosphere_command,
        add_tables_command, add_lines_command, add_bodies_command}},
      {"Files for other programs",
       {add_export_command, add_track_command, add_to_netcdf_command, add_to_gemini_command,
        add_to_lompe_command}},
      {"Reference", {add_params_command, add_manual_command}},
  };
}

}  // namespace vegard::apps
