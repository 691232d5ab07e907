// A request of `vegard invert`, checked against what the lines can tell.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/options/spectrum_options.h"
#include "fit/columns/column_chi2.h"
#include "fit/columns/column_model.h"
#include "fit/report/columns/inversion_texts.h"
#include "sim/light/tables/emission_tables.h"

namespace vegard::apps {

inline constexpr const char* kHoldOptions[fit::kColumnUnknowns] = {"--energy-kev", "--flux-mw-m2",
                                                                   "--oxygen-factor", "--soft-ratio"};

/// What is asked of density profiles.
struct DensityRequest {
  std::string file, atmosphere = "tables", recombination = "chemistry";
  std::vector<double> altitudes_km = {85.0, 150.0}, energies_kev;
  std::optional<double> beam;
  bool is_steady = false;
};

struct InvertRequest {
  std::vector<std::string> lines, maps, errors, outputs, free = {"energy", "flux"};
  std::string relative_error, model_error, tables = sim::kDefaultEmissionTables, uncertainty = "modes", plot,
                                           command;
  SpectrumOptions spectrum;
  std::optional<double> soft_kev;
  std::array<std::optional<double>, fit::kColumnUnknowns> held;
  std::string table;
  DensityRequest density;
  int threads = 0;
  bool overwrite = false, common_physics = false;
};

/// "5" or "5%" of an option in per cent.
double share_of(const std::string& text, const char* option);

/// The model of the lines, once they are known to determine what is asked of them.
class Inversion {
 public:
  /// Throws Error(usage) for lines that do not determine the unknowns, and for values outside of the tables.
  Inversion(const InvertRequest& request, const std::vector<double>& lines_nm);

  const fit::ColumnModel& model() const { return model_; }
  const fit::ColumnFreedom& free() const { return free_; }
  const fit::ColumnPoint& fixed() const { return fixed_; }
  const fit::ColumnModelOptions& options() const { return options_; }
  const sim::EmissionTables& tables() const { return tables_; }
  fit::ColumnChi2 chi2(std::size_t stride) const { return {model_, free_, fixed_, stride}; }
  fit::InversionFacts facts(const InvertRequest& request) const;

 private:
  void require_inside(std::size_t k, const InvertRequest& request) const;
  void require_enough_lines(const InvertRequest& request) const;

  fit::ColumnFreedom free_;
  fit::ColumnPoint fixed_{};
  const sim::EmissionTables& tables_;
  fit::ColumnModelOptions options_;
  fit::ColumnModel model_;
};

/// Refuses outputs that are inputs, or each other.
void spare_inputs(const InvertRequest& request, const std::vector<std::string>& inputs);

/// Returns the tables that --tables names. Throws Error about the option for tables that cannot be read.
const sim::EmissionTables& inversion_tables(const InvertRequest& request);

/// The options that belong to --density alone.
void add_density_options(const Command& command, DensityRequest& request);

/// Return the exit code.
int invert_lines(const InvertRequest& request);
int invert_line_maps(const InvertRequest& request);
int invert_table(const InvertRequest& request);
int invert_density(const InvertRequest& request);

}  // namespace vegard::apps
