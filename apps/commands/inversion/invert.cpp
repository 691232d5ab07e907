#include <memory>

#include "apps/commands/commands.h"
#include "apps/commands/inversion/invert_request.h"
#include "apps/options/refusals.h"
#include "fit/columns/column_model.h"

namespace vegard::apps {

void add_invert_command(Program& program) {
  const auto options = std::make_shared<InvertRequest>();
  const Command command = program.add(
      "invert",
      "Compute electrons' energy flux and energy from the brightness of lines, maps of it, or densities");
  const Option line = command
                          .option("--line", options->lines,
                                  "A line's brightness in rayleighs of the vertical column, 427.8=2300±50 or "
                                  "427.8=2300+-2%; at least as many as are free, at most eight")
                          .type_name("NM=R±ERROR")
                          .repeated();
  command
      .option(
          "--map", options->maps,
          "In place of --line: an image of the brightness (FITS, EXR, TIFF of floats); of an EXR the channel "
          "of the line, as vegard render --lines writes it")
      .type_name("NM=FILE")
      .repeated()
      .excludes(line);
  command
      .option(
          "--table", options->table,
          "In place of --line: a table of a night's brightnesses, a row a time, inverted together: what is "
          "learnt of the tables' light by all rows holds for each")
      .type_name("FILE.csv")
      .excludes(line);
  command
      .option("--error", options->errors,
              "Error of a map: in rayleighs, in per cent or an image; several of one line are added in "
              "quadrature")
      .type_name("NM=R|%|FILE")
      .repeated();
  command
      .option("--relative-error", options->relative_error,
              "Error in per cent of lines without one of their own")
      .type_name("PERCENT");
  command
      .option("--model-error", options->model_error,
              "Error of the tables, in per cent of each line, added in quadrature to its own error")
      .type_name("PERCENT");
  command
      .option("--uncertainty", options->uncertainty,
              "Errors contain the tables' own uncertainty (modes), or take the tables as exact (none)")
      .one_of({"modes", "none"})
      .shows_default();
  command.flag("--common-physics", options->common_physics,
               "With --map: the pixels have their physics in common, of which they tell together");
  add_density_options(command, options->density);
  add_spectrum_options(command, options->spectrum);
  command
      .option("--soft-kev", options->soft_kev,
              "E0 in keV of a second, soft component of Maxwellian electrons (default: 0.3), whose energy "
              "flux is in --free or --soft-ratio")
      .finite_range(0.1, 19.0);
  command
      .option("--tables", options->tables,
              "Emission tables: those of the program by name, or a folder such as vegard tables writes")
      .type_name("NAME|FOLDER")
      .shows_default();
  command.option("--free", options->free, "What to find (default: energy,flux)")
      .delimiter(',')
      .one_an_occurrence()
      .one_of({"energy", "flux", "oxygen", "soft"})
      .type_name("WORDS");
  command.option("--energy-kev", options->held[fit::kLnEnergy], "E0 in keV, where it is not free")
      .finite_range(1e-3, 1e3);
  command.option("--flux-mw-m2", options->held[fit::kLnFlux], "Energy flux in mW m^-2, where it is not free")
      .finite_range(fit::ColumnModel::kMinFlux, fit::ColumnModel::kMaxFlux);
  command
      .option("--oxygen-factor", options->held[fit::kLnOxygen],
              "Atomic oxygen over that of the tables (default: 1)")
      .finite_range(1e-2, 1e2);
  command
      .option("--soft-ratio", options->held[fit::kLnSoft],
              "Energy flux of the soft component over that of the rest, where it is not free")
      .finite_range(fit::ColumnModel::kMinSoftRatio, fit::ColumnModel::kMaxSoftRatio);
  command
      .option("-o,--output", options->outputs,
              "The result to write: JSON of lines; FITS or netCDF-4 of maps, or one of each; a table; of "
              "densities JSON, a table or netCDF-4")
      .type_name("OUT.json|.fits|.nc|.csv")
      .repeated();
  command.option("--plot", options->plot, "Draw chi2 over energy and flux, or spectrum and density")
      .type_name("OUT.svg|OUT.png");
  add_threads_option(command, options->threads);
  command.flag("--overwrite", options->overwrite, "Replace outputs that exist");
  command.runs([options] {
    if (!options->density.file.empty()) return invert_density(*options);
    if (!options->table.empty()) return invert_table(*options);
    if (options->lines.empty() && options->maps.empty())
      throw usage_error(
          "--line", "no line is given",
          "--line NM=RAYLEIGHS±ERROR or --map NM=FILE, two or more, --table FILE or --density FILE");
    return options->maps.empty() ? invert_lines(*options) : invert_line_maps(*options);
  });
}

}  // namespace vegard::apps
