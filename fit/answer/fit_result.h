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
#include "fit/search/descent.h"
#include "fit/uncertainty/validated_errors.h"
#include "sim/emit/aurora/foot_line.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// One of the models that were compared when a map's curtains were refined (fit/curtain_fit.h).
struct CurveStep {
  enum class Change { start, drop, add } change = Change::start;
  std::string curve;  ///< the sheet that was left out or added; empty of the start
  int curves = 0;     ///< of this model
  double chi2 = 0.0;  ///< where it has settled
  int values = 0, unknowns = 0;
  double bic_lower_by = 0.0;  ///< than the model before it: above 0 it favours the change
  bool kept = true;           ///< whether the change has stayed
};

enum class Verdict {
  good,         ///< converged, and nothing speaks against the answer
  doubtful,     ///< converged, but the reasons say why not to lean on it
  failed,       ///< did not converge
  interrupted,  ///< stopped by the user; the best so far
};

/// "good", "doubtful", "failed", "interrupted".
const char* verdict_name(Verdict verdict);
constexpr Verdict kVerdicts[] = {Verdict::good, Verdict::doubtful, Verdict::failed, Verdict::interrupted};

struct FittedParameter {
  std::string path;   ///< "sheet.main.center_km.east"; "camera.roll_deg of south" if a photograph's own
  std::string photo;  ///< that photograph's name; empty: shared by all
  std::string unit;
  std::string meaning;
  double value = 0.0;
  double initial = 0.0;         ///< where the search started
  double min = 0.0, max = 0.0;  ///< limits in force; +-infinity where there is none
  std::optional<double>
      sigma;  ///< 68 % half-width carried back through the transform; none if it has no error bar
  std::optional<std::pair<double, double>> interval68;  ///< carried back exactly, may be lopsided
  bool at_limit = false;
  bool moved = true;                  ///< further than rounding from `initial`
  std::optional<double> moved_sigma;  ///< how far, in units of sigma; none without an error bar
  bool of_profile = false;            ///< a coefficient of one of FitResult::profiles, which say it better
  std::string why_no_sigma;           ///< in words, if sigma is missing
};

/// A number that follows from others (fit.tied), or is the same as another by its name.
struct TiedNumber {
  std::string path;
  std::string unit;
  std::string meaning;
  std::string equals;  ///< the expression, or the path of the number that it is
  double value = 0.0;
  std::optional<double> sigma;  ///< to first order; none where it leans on what has no error bar
};

/// A transfer curve that was unknown, found together with the scene (fit/curve_fit.h): exponents over sRGB's
/// light (sim/view/sensor/transfer_curve.h).
struct FittedCurve {
  struct Exponent {
    std::string name;  ///< "of all light", "at black", "at white"
    double value = 1.0;
    double sigma = 0.0;  ///< limits included
    bool at_limit = false, undetermined = false;
  };
  std::vector<Exponent> exponents;
  double correlation = 0.0;        ///< of two
  double least = 0.0, most = 0.0;  ///< between which they were looked for
  std::string words;               ///< "sRGB to the power of 1.31 ± 0.05"
  std::string decoding_word;       ///< that says it is known to be this: "srgb:1.31"
  /// What was tried: exponents, then -2 ln likelihood above the least.
  std::vector<std::vector<double>> trials;
};

/// A number that was solved for, not searched: a gain or a sky term.
struct SolvedNumber {
  std::string name;  ///< "gain.band_3", "sky.level.red"
  double value = 0.0;
  std::optional<double> sigma;
};

/// One of the statistics that photograph and model were compared by (fit/compare/statistics.h).
struct ComparedStatistic {
  std::string name;  ///< "profile", "colour"
  double weight = 1.0;
  int residuals = 0;
  double chi2 = 0.0;  ///< weight included
};

/// What follows from the parameters and is what people publish.
struct DerivedNumber {
  /// Statistical and systematic, in quadrature.
  std::optional<double> error() const;

  std::string name;             ///< "distance of the main sheet"
  double value = 0.0;           ///< NaN if it is unconstrained
  std::optional<double> sigma;  ///< statistical
  std::string unit;
  std::string why_none{};      ///< in words, if there is no value
  std::string why_no_sigma{};  ///< in words, if there is a value without an error bar; may be empty
  bool is_detail = false;      ///< for tables, not for the few numbers that one wants to see first
  Quantity quantity = Quantity::other;
  bool is_lateral = false;  ///< of a sheet's way from band to band
  /// Paths of the free numbers whose error bar gives a tenth of this one's variance or more.
  std::vector<std::string> depends_on{};
  Trust trust = Trust::unconstrained;  ///< assess_quantities()
  std::string trust_reason{};
  std::optional<double>
      at_other_mode{};  ///< where another end explains the data almost as well; none: nowhere
  std::optional<double>
      systematic{};  ///< by the choices that the fit rests on (fit/stability.h); none: not asked
};

/// A fit with one of its choices made otherwise (fit/stability.h).
struct StabilityRow {
  struct Shift {
    double by = std::numeric_limits<double>::quiet_NaN();  ///< from the answer, in the number's unit
    double variance_by_chance = 0.0;
  };
  std::string choice;   ///< "region"
  std::string name;     ///< "without its left third"
  std::string problem;  ///< in words, if nothing came of it
  double chi2_per_dof = std::numeric_limits<double>::quiet_NaN();
  bool is_refuted = false;     ///< the picture itself speaks against it: it has no effect
  std::vector<Shift> derived;  ///< as FitResult::derived; empty with a problem
};

/// A free-form height profile with its band.
struct FreeProfile {
  std::string sheet;
  double wavelength_nm = 0.0;
  std::vector<double> altitude_km;
  std::vector<double> rate;          ///< photons cm^-3 s^-1 per mW m^-2, in the scale that the fit holds
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
  sim::Scene best;             ///< the best scene as it sees it, with its own gain and sky written into it
  Profile data;                ///< of the photograph
  std::vector<double> sigma;   ///< total standard deviation of every profile value, indexed as in `data`
  std::vector<double> model;   ///< profile of the best model, sky included, indexed as in `data`
  std::vector<double> behind;  ///< what of `model` no gain multiplies: the solved sky and known lights
  std::vector<std::vector<double>> gain;  ///< [band][channel]: what the aurora was multiplied by
  std::vector<SolvedNumber> solved;
  double chi2 = 0.0;           ///< its share
  double rms_over_peak = 0.0;  ///< rms residual over all rows, bands, channels / peak of its profile above
                               ///< the sky (rms_over_peak() in fit/answer/answer.h)
  /// Unmodelled structure as the residuals have it (found_model_error()), the simulation's own sampling among
  /// it: a share of the light above the sky. None if that is not known.
  std::optional<double> model_error;
  std::string decoding;
};

/// One of the questions behind a verdict.
struct Check {
  std::string name;  ///< "level": a word or two
  bool passed = false;
  std::string words;  ///< what was found, in a sentence's part
};

/// What the model was compared with: two fits can be weighed against each other if it is the same for both.
struct ComparedValues {
  std::vector<std::array<int, 4>> regions_px;  ///< of every photograph: x, y, width, height
  int values = 0;                              ///< statistics with a sigma, of all photographs
  double sum_of_weights = 0.0;  ///< of 1 / sigma^2, the simulation's own sampling left out of sigma
  double sampling_error = 0.0;  ///< that sampling's, as a fraction of the brightness; the largest
  int unknowns = 0;             ///< free and solved for, less what is held
  bool draws = false;           ///< whether one draw of beams was compared, not the mean over all (fit.model)
};

struct FitResult {
  Verdict verdict = Verdict::failed;
  std::string verdict_line;          ///< one sentence: whether to believe it, and why
  std::vector<std::string> reasons;  ///< what speaks against it, or is worth knowing; may be empty
  std::vector<Check> checks;         ///< what the verdict has asked, in its order
  std::vector<FittedParameter> parameters;
  std::vector<TiedNumber> tied;
  std::vector<DerivedNumber> derived;
  std::optional<FittedCurve> curve;              ///< of a photograph whose transfer curve was unknown
  std::vector<sim::FootBand> foot_bands;         ///< one per sheet
  std::vector<FreeProfile> profiles;             ///< of every sheet and line whose coefficients were free
  std::vector<std::vector<double>> correlation;  ///< of `parameters`; rows without an error bar hold zeros
  std::vector<std::string> trade_offs;           ///< a sentence for each strong correlation
  std::vector<std::string> undetermined;  ///< a sentence for each change that the data cannot determine

  // The validation of the error bars, where it was requested.
  std::vector<ProfiledInterval> profile_intervals;
  std::optional<BootstrapErrors> bootstrap;
  std::optional<ChainErrors> chain;
  std::vector<CurveStep> curve_steps;  ///< of a fit that began with a map's curtains; else none

  std::optional<std::vector<StabilityRow>> stability;  ///< where it was asked for

  bool validation_interrupted = false;  ///< the user stopped: the rest is the whole answer all the same

  double chi2 = 0.0;
  double chi2_initial = 0.0;
  std::vector<ComparedStatistic> statistics;  ///< what chi2 is made of, priors aside
  int dof = 0;
  ComparedValues compared;
  /// Largest |cosine| between the residuals and a column of the Jacobian at the end
  /// (fit/search/gradient_cosine.h); NaN if it is not known.
  double gradient_cosine = std::numeric_limits<double>::quiet_NaN();
  double rms_over_peak = 0.0;    ///< of the photograph that has the largest
  double error_inflation = 1.0;  ///< factor on the error bars for the residuals' size and correlation
  double independent_per_unknown = std::numeric_limits<double>::infinity();  ///< residuals, by assess_fit()
  double correlated_residuals = 1.0;  ///< that go up and down as one (fit/compare/inflation.h)
  std::string termination;            ///< in words, Ceres' own after ours
  int evaluations = 0;                ///< of the residuals, search included
  int jacobian_evaluations = 0;
  std::uint64_t seed = 0;

  /// The scene with the best values, gain and sky written into it. Of several photographs: what they share,
  /// each one's own in its entry of fit.photos.
  sim::Scene best;
  std::vector<FittedPhoto> photos;  ///< at least one; in the order of fit.photos
  std::vector<TraceRow> trace;

  std::vector<InputFile> inputs;
  std::vector<PhotoFact> from_photograph;  ///< what the scene did not give and was taken from there
  std::string command;
};

}  // namespace vegard::fit
