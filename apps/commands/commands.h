// The subcommands, each in a file of this folder with its options, its work and its exit code.
#pragma once

#include "apps/options/command.h"

namespace vegard::apps {

/// Each function adds its subcommand to the program, whose run() may throw sim::Error.
void add_animate_command(Program& program);
void add_atmosphere_command(Program& program);
void add_bodies_command(Program& program);
void add_border_command(Program& program);
void add_brightness_command(Program& program);
void add_calibrate_command(Program& program);
void add_compare_command(Program& program);
void add_describe_command(Program& program);
void add_directions_command(Program& program);
void add_electrons_command(Program& program);
void add_tables_command(Program& program);
void add_fit_command(Program& program);
void add_grid_command(Program& program);
void add_horizon_command(Program& program);
void add_invert_command(Program& program);
void add_keogram_command(Program& program);
void add_linearise_command(Program& program);
void add_lines_command(Program& program);
void add_map_command(Program& program);
void add_mask_command(Program& program);
void add_measure_command(Program& program);
void add_params_command(Program& program);
void add_photometry_command(Program& program);
void add_points_command(Program& program);
void add_preview_command(Program& program);
void add_profile_command(Program& program);
void add_manual_command(Program& program);
void add_render_command(Program& program);
void add_sdf_command(Program& program);
void add_sequence_command(Program& program);
void add_slices_command(Program& program);
void add_survey_command(Program& program);
void add_to_gemini_command(Program& program);
void add_to_lompe_command(Program& program);
void add_to_netcdf_command(Program& program);
void add_volume_command(Program& program);

}  // namespace vegard::apps
