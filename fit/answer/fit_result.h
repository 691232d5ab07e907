// The result of a fit, complete enough to write a run directory and a report from it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/answer/trust.h"
#include "fit/measure/profile.h"
#include "fit/photo/photo_facts.h"
#include "fit/radar/fitted_radar.h"
#include "fit/search/descent.h"
#include "fit/uncertainty/mode_information.h"
#include "fit/uncertainty/validated_errors.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// A step in the refinement of a map's curtains: one of the models that were compared (fit/curtain_fit.cpp).
struct CurtainStep {
  enum class Change { start, drop, add } change = Change::start;
  std::string curtain;  ///< the sheet that was left out or added; empty for the start
  int curtains = 0;     ///< number of curtains in this model
  double chi2 = 0.0;    ///< after its fit
  int values = 0, unknowns = 0;
  double bic_lower_by = 0.0;  ///< than that of the model before; above 0 it favours the change
  bool kept = true;           ///< whether the change was kept
};

enum class Verdict {
  good,         ///< converged, and no reason to doubt the answer
  doubtful,     ///< converged, but the reasons tell why it is in doubt
  failed,       ///< did not converge
  interrupted,  ///< stopped by the user; the best so far
};

/// "good", "doubtful", "failed", "interrupted".
const char* verdict_name(Verdict verdict);
constexpr Verdict kVerdicts[] = {Verdict::good, Verdict::doubtful, Verdict::failed, Verdict::interrupted};

struct FittedParameter {
  std::string path;   ///< "sheet.main.center_km.east"; "camera.roll_deg of south" (of one photograph)
  std::string photo;  ///< name of that photograph; empty: shared by all
  std::string unit;
  std::string meaning;
  double value = 0.0;
  double initial = 0.0;         ///< where the search started
  double min = 0.0, max = 0.0;  ///< limits in force; +-infinity where there is none
  std::optional<double> sigma;  ///< half-width of the 68 % interval, in `unit`; none without an error bar
  std::optional<std::pair<double, double>> interval68;  ///< transformed back exactly; may be asymmetric
  bool at_limit = false;
  bool moved = true;                  ///< whether `value` differs from `initial` by more than rounding
  std::optional<double> moved_sigma;  ///< by how much, in units of sigma; none without an error bar
  bool of_profile = false;            ///< a coefficient of one of FitResult::profiles, which show it better
  std::string why_no_sigma;           ///< the reason, if sigma is missing
  /// By what factor the scatter of the picture's bands has widened sigma without the physics
  /// (fit/uncertainty/band_scatter.h), at least 1.
  double by_bands = 1.0;
  /// Changes by one standard deviation of each considered mode of the emission tables, in `unit`.
  std::vector<double> by_mode{};
  bool relative = false;  ///< its search is in the logarithm
};

/// A number that is computed from others (fit.tied), or equals another one that has the same name in
/// fit.free.
struct TiedNumber {
  std::string path;
  std::string unit;
  std::string meaning;
  std::string equals;  ///< the expression, or the path of the number that it equals
  double value = 0.0;
  std::optional<double> sigma;  ///< to first order; none if it depends on a number without an error bar
};

/// A transfer curve that was unknown, found together with the scene (fit/transfer_curve_fit.cpp): exponents
/// over sRGB's light (sim/view/sensor/tone_curve.h).
struct FittedTransferCurve {
  struct Exponent {
    std::string name;  ///< "of all light", "at black", "at white"
    double value = 1.0;
    double sigma = 0.0;  ///< the effect of the limits included
    bool at_limit = false, undetermined = false;
  };
  std::vector<Exponent> exponents;
  double correlation = 0.0;        ///< of two exponents
  double least = 0.0, most = 0.0;  ///< range of the search
  std::string words;               ///< "sRGB to the power of 1.31 ± 0.05"
  std::string decoding_word;       ///< the word for this curve in fit.decoding: "srgb:1.31"
  /// Trials of the search: the exponents, then -2 ln likelihood above its minimum.
  std::vector<std::vector<double>> trials;
};

/// A number that was solved for, not searched: a gain or a sky term.
struct SolvedNumber {
  std::string name;  ///< "gain.band_3", "sky.level.red"
  double value = 0.0;
  std::optional<double> sigma;
  /// Changes by each considered mode of the emission tables, the answer's shift included; part of sigma.
  std::vector<double> by_mode{};
};

/// One of the statistics that photograph and model were compared by (fit/compare/statistics.h).
struct ComparedStatistic {
  std::string name;  ///< "profile", "colour"
  double weight = 1.0;
  int residuals = 0;
  double chi2 = 0.0;  ///< weight included
};

/// A quantity for publication, computed from the parameters.
struct DerivedNumber {
  /// Statistical and systematic error in quadrature.
  std::optional<double> error() const;

  std::string name;             ///< "distance of the main sheet"
  double value = 0.0;           ///< NaN if it is unconstrained
  std::optional<double> sigma;  ///< statistical
  std::string unit;
  std::string why_none{};      ///< the reason, if there is no value
  std::string why_no_sigma{};  ///< the reason, if there is a value without an error bar; may be empty
  bool is_detail = false;      ///< for tables only, not for the summary of the most important numbers
  Quantity quantity = Quantity::other;
  bool is_lateral = false;  ///< describes a sheet's course across the bands: bearing, length, width, sine
  /// Paths of the free numbers whose error bars cause a tenth or more of this number's variance.
  std::vector<std::string> depends_on{};
  Trust trust = Trust::unconstrained;  ///< assess_quantities()
  std::string trust_reason{};
  std::optional<double> at_other_mode{};  ///< its value at a second minimum of chi2, if there is one
  std::optional<double> systematic{};     ///< by choices of the analysis (fit/stability.h), if requested
  std::vector<double> by_mode{};          ///< as FittedParameter::by_mode
};

/// What the data ask of the emission tables' light of a line, over that of another line
/// (fit/answer/tables_correction.h).
struct TablesCorrection {
  double wavelength_nm = 0.0, over_nm = 0.0;
  double factor = 1.0;              ///< on the tables' ratio
  double ln_sigma = 0.0;            ///< standard deviation of its logarithm
  double ln_sigma_of_tables = 0.0;  ///< before these data
};

/// A fit with one of its choices changed (fit/stability.h).
struct StabilityRow {
  struct Shift {
    double by = std::numeric_limits<double>::quiet_NaN();  ///< shift from the answer, in the number's unit
    double variance_by_chance = 0.0;
  };
  std::string choice;   ///< "region"
  std::string name;     ///< "without its left third"
  std::string problem;  ///< the reason, if the fit gave no result
  double chi2_per_dof = std::numeric_limits<double>::quiet_NaN();
  bool is_refuted = false;     ///< chi2 refutes the choice, so its shifts are ignored
  std::vector<Shift> derived;  ///< in the order of FitResult::derived; empty if there is a problem
};

/// A free-form height profile with its error band.
struct FreeProfile {
  std::string sheet;
  double wavelength_nm = 0.0;
  std::vector<double> altitude_km;
  std::vector<double> rate;          ///< at the scale that the fit holds fixed
  std::vector<double> lower, upper;  ///< of the 68 % interval at each altitude
};

struct InputFile {
  std::string role;  ///< "scene", "photo", "mask"
  std::string name;  ///< without its folder
  std::string sha256;
};

/// What belongs to one photograph of a fit.
struct FittedPhoto {
  std::string name;            ///< of its entry; empty if it is the only one
  sim::Scene best;             ///< the best scene in this photograph's frame, with its own gain and sky
  Profile data;                ///< of the photograph
  std::vector<double> sigma;   ///< total standard deviation of every profile value, indexed as in `data`
  std::vector<double> model;   ///< profile of the best model, sky included, indexed as in `data`
  std::vector<double> behind;  ///< part of `model` that no gain multiplies: solved sky and known lights
  std::vector<std::vector<double>> gain;  ///< factor on the model's aurora
  std::vector<SolvedNumber> solved;
  double chi2 = 0.0;           ///< its part of the whole chi2
  double rms_over_peak = 0.0;  ///< rms residual over all rows, bands, channels / peak of its profile above
                               ///< the sky (rms_over_peak() in fit/answer/answer.h)
  /// Estimate of unmodelled structure from the residuals (found_model_error()), the sampling noise of the
  /// simulation included: a fraction of the light above the sky. None if it is not known.
  std::optional<double> model_error;
  std::string decoding;
};

/// One of the tests on which the verdict is based.
struct Check {
  std::string name;  ///< "level": a word or two
  bool passed = false;
  std::string words;  ///< the finding, as part of a sentence
};

/// The data that the model was compared with. Two fits can be compared only if these are the same for both.
struct ComparedValues {
  std::vector<std::array<int, 4>> regions_px;  ///< of every photograph: x, y, width, height
  int values = 0;                              ///< number of compared values with a sigma, of all photographs
  double sum_of_weights = 0.0;  ///< of 1 / sigma^2, where sigma excludes the sampling noise of the simulation
  double sampling_error = 0.0;  ///< that sampling noise, as a fraction of the brightness; the largest
  int unknowns = 0;             ///< number of free and solved parameters, without held gains
  bool draws = false;           ///< whether the model was one random draw of beams, not the mean (fit.model)
};

struct FitResult {
  Verdict verdict = Verdict::failed;
  std::string verdict_line;          ///< one sentence: whether the answer can be trusted, and why
  std::vector<std::string> reasons;  ///< reasons against the answer, and notes; may be empty
  std::vector<Check> checks;         ///< the tests behind the verdict, in their order
  std::vector<FittedParameter> parameters;
  std::vector<TiedNumber> tied;
  std::vector<DerivedNumber> derived;
  std::vector<TablesCorrection> tables;  ///< of lines of which the data say something; not applied
  ModeInformation physics;               ///< what the data say of the modes, for several pictures together
  std::optional<FittedTransferCurve> transfer_curve;  ///< of a photograph whose transfer curve was unknown
  std::vector<sim::FootBand> foot_bands;              ///< one per sheet
  std::vector<FittedRadar> radars;                    ///< in the order of fit.radars
  std::vector<FreeProfile> profiles;             ///< of every sheet and line whose coefficients were free
  std::vector<std::vector<double>> correlation;  ///< of `parameters`; rows without an error bar hold zeros
  std::vector<std::string> trade_offs;           ///< a sentence for each strong correlation
  std::vector<std::string> undetermined;  ///< a sentence for each change that the data cannot determine

  // The validation of the error bars, where it was requested.
  std::vector<ProfiledInterval> profile_intervals;
  std::optional<BootstrapErrors> bootstrap;
  std::optional<ChainErrors> chain;
  std::vector<CurtainStep> curtain_steps;  ///< of a fit that started from a map's curtains; else empty

  std::optional<std::vector<StabilityRow>> stability;  ///< where it was requested

  bool validation_interrupted = false;  ///< the user stopped the validation; everything else is complete

  double chi2 = 0.0;
  double chi2_initial = 0.0;
  std::vector<ComparedStatistic>
      statistics;  ///< the contributions to chi2, radars' among them, without priors
  int dof = 0;
  ComparedValues compared;
  /// Largest |cosine| between the residuals and a column of the Jacobian at the end
  /// (fit/search/descent.h); NaN if it is not known.
  double gradient_cosine = std::numeric_limits<double>::quiet_NaN();
  double rms_over_peak = 0.0;    ///< that of the photograph with the largest one
  double error_inflation = 1.0;  ///< factor on the error bars for the residuals' size and correlation
  double independent_per_unknown =
      std::numeric_limits<double>::infinity();  ///< effective sample size per unknown, set by assess_fit()
  double correlated_residuals = 1.0;  ///< correlated residuals per independent one (fit/compare/inflation.h)
  std::string termination;            ///< why the search ended, in words; Ceres' own words come last
  int evaluations = 0;                ///< number of evaluations of the residuals, search included
  int jacobian_evaluations = 0;
  std::uint64_t seed = 0;

  /// The scene with the best values, gain and sky written into it. With several photographs it holds what
  /// they share, and the entries of fit.photos hold what belongs to each.
  sim::Scene best;
  std::vector<FittedPhoto> photos;  ///< at least one; in the order of fit.photos
  std::vector<TraceRow> trace;

  std::vector<InputFile> inputs;
  std::vector<PhotoFact> from_photograph;  ///< values that the scene took from the photograph's file
  std::string command;
};

}  // namespace vegard::fit
