// Information criteria compare models of one photograph: they weigh chi2 against the number of parameters.
//
// AIC: H. Akaike, "A new look at the statistical model identification", IEEE Trans. Automatic Control 19
// (1974) 716, doi:10.1109/TAC.1974.1100705. AICc: C. M. Hurvich and C.-L. Tsai, Biometrika 76 (1989) 297,
// doi:10.1093/biomet/76.2.297. BIC: G. Schwarz, "Estimating the dimension of a model", Annals of Statistics 6
// (1978) 461, doi:10.1214/aos/1176344136.
#pragma once

#include <string>

namespace vegard::fit {

/// What a fit has come to. Of models that are to be compared, of the same values with the same sigma.
struct FittedModel {
  std::string name;  ///< as it stands in a sentence: "two sheets"
  double chi2 = 0.0;
  int values = 0;         ///< that were compared
  int parameters = 0;     ///< free and solved for
  double together = 1.0;  ///< correlated residuals per independent one: FitResult::correlated_residuals
};

/// The scaling of chi2 for correlated residuals and underestimated errors; one for all models that are
/// compared.
///
/// Residuals that go together, or are larger than their sigma, make chi2 too large by the number that is
/// worth one times chi2 per degree of freedom. So chi2 is divided by both, as the quasi-likelihood criteria
/// do by their variance inflation factor (K. P. Burnham and D. R. Anderson, "Model selection and multimodel
/// inference", 2nd ed., Springer 2002, section 2.5; they too take it from the richest model, and nothing
/// below 1). The number of independent values is the number of values divided by those that are worth one.
struct ChiSquareScaling {
  double chi2_divisor = 1.0;
  double together = 1.0;  ///< correlated values per independent one
};
ChiSquareScaling chi2_scaling_of(const FittedModel& richest);

struct InformationCriteria {
  double chi2 = 0.0;    ///< divided
  double values = 0.0;  ///< independent ones
  double aic = 0.0;     ///< chi2 + 2 k
  double aicc = 0.0;    ///< AIC + 2 k (k + 1) / (n - k - 1); +infinity where n <= k + 1
  double bic = 0.0;     ///< chi2 + k ln n
};
InformationCriteria information_criteria(const FittedModel& model, const ChiSquareScaling& scaling);

/// The words of R. E. Kass and A. E. Raftery, "Bayes factors", J. American Statistical Association 90 (1995)
/// 773, doi:10.1080/01621459.1995.10476572, section 3.2, for twice the logarithm of a Bayes factor, which a
/// difference of BIC approximates (their section 4.1.3): "not worth more than a bare mention" to 2,
/// "positive" to 6, "strong" to 10, "very strong" above.
std::string evidence_words(double bic_difference);

/// "two sheets explain it better than one sheet: BIC lower by 35 (very strong evidence)". Where AICc speaks
/// for the other one, that is said too. The errors are believed as far as the model with more parameters has
/// it. The names stand as plurals if they end in "s".
std::string compared_in_words(const FittedModel& one, const FittedModel& two);

}  // namespace vegard::fit
