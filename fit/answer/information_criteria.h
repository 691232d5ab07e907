// Information criteria compare models of one photograph: they weigh chi2 against the number of parameters.
//
// AIC: H. Akaike, "A new look at the statistical model identification", IEEE Trans. Automatic Control 19
// (1974) 716, doi:10.1109/TAC.1974.1100705. AICc: C. M. Hurvich and C.-L. Tsai, Biometrika 76 (1989) 297,
// doi:10.1093/biomet/76.2.297. BIC: G. Schwarz, "Estimating the dimension of a model", Annals of Statistics 6
// (1978) 461, doi:10.1214/aos/1176344136.
#pragma once

#include <string>

namespace vegard::fit {

/// The outcome of a fit, as far as information criteria need it. Models can only be compared for the same
/// values with the same sigma.
struct FittedModel {
  std::string name;  ///< as in a sentence: "two sheets"
  double chi2 = 0.0;
  int values = 0;           ///< number of compared values
  int parameters = 0;       ///< number of free and solved parameters
  double correlated = 1.0;  ///< correlated residuals per independent one: FitResult::correlated_residuals
};

/// The scaling of chi2 for correlated residuals and underestimated errors; one for all models that are
/// compared.
///
/// Residuals that are correlated, or larger than their sigma, make chi2 too large: by the number of
/// correlated residuals per independent one, times chi2 per degree of freedom. So chi2 is divided by both, as
/// the quasi-likelihood criteria do by their variance inflation factor (K. P. Burnham and D. R. Anderson,
/// "Model selection and multimodel inference", 2nd ed., Springer 2002, section 2.5; they too take it from the
/// richest model, and not below 1). The effective sample size is the number of values divided by the number
/// of correlated values per independent one.
struct ChiSquareScaling {
  double chi2_divisor = 1.0;
  double correlated = 1.0;  ///< correlated values per independent one
};
ChiSquareScaling chi2_scaling_of(const FittedModel& richest);

/// The criteria of a model with k parameters and effective sample size n.
struct InformationCriteria {
  double chi2 = 0.0;    ///< scaled: divided by ChiSquareScaling::chi2_divisor
  double values = 0.0;  ///< effective sample size n
  double aic = 0.0;     ///< chi2 + 2 k
  double aicc = 0.0;    ///< AIC + 2 k (k + 1) / (n - k - 1); +infinity where n <= k + 1
  double bic = 0.0;     ///< chi2 + k ln n
};
InformationCriteria information_criteria(const FittedModel& model, const ChiSquareScaling& scaling);

/// Returns the words of R. E. Kass and A. E. Raftery, "Bayes factors", J. American Statistical Association 90
/// (1995) 773, doi:10.1080/01621459.1995.10476572, section 3.2, for twice the logarithm of a Bayes factor,
/// which a difference of BIC approximates (their section 4.1.3): "not worth more than a bare mention" to 2,
/// "positive" to 6, "strong" to 10, "very strong" above.
std::string evidence_words(double bic_difference);

/// Returns "two sheets explain it better than one sheet: BIC lower by 35 (very strong evidence)". The
/// sentence says also if AICc favours the other model. The scaling of chi2 is that of the model with more
/// parameters. Names that end in "s" are treated as plurals.
std::string compared_in_words(const FittedModel& one, const FittedModel& two);

}  // namespace vegard::fit
