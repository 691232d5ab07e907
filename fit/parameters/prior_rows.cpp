#include "fit/parameters/prior_rows.h"

#include <algorithm>
#include <cmath>

#include "sim/scene/table/free_entry_keys.h"

namespace vegard::fit {

PriorRows::PriorRows(const std::vector<FreeNumber>& free, double weight) {
  for (std::size_t j = 0; j < free.size(); ++j) {
    if (free[j].ratio_prior) add_ratio(free, j, weight);
    if (!free[j].prior || free[j].prior->law == sim::PriorLaw::uniform) continue;
    if (free[j].prior->law == sim::PriorLaw::log_normal) {
      add_of_sum(weight / free[j].prior->sigma, std::log(free[j].prior->mean), 0.0,
                 {{static_cast<int>(j), 1.0}});
      continue;
    }
    Row row;
    row.factor = weight / free[j].prior->sigma;
    row.target = free[j].prior->mean;
    row.terms = {{static_cast<int>(j), 1.0}};
    rows_.push_back(row);
  }
}

void PriorRows::add_ratio(const std::vector<FreeNumber>& free, std::size_t j, double weight) {
  const RatioPrior& prior = *free[j].ratio_prior;
  Row row;
  row.kind = Row::Kind::of_range;
  row.factor = weight / prior.spread;
  row.constant = prior.rest;
  row.least = std::log(kMinWavelengthRatio);
  row.most = std::log(kMaxWavelengthRatio);
  row.terms = {{static_cast<int>(j), prior.sign}};
  if (prior.other) {
    const auto other =
        std::find_if(free.begin(), free.end(), [&](const FreeNumber& n) { return n.id == *prior.other; });
    if (other == free.end()) return;  // one number by itself: the ratio says nothing of it
    row.terms.push_back({static_cast<int>(other - free.begin()), -prior.sign});
  }
  rows_.push_back(row);
}

void PriorRows::add_of_logarithms(const std::vector<LogTerm>& terms) {
  Row row;
  row.kind = Row::Kind::of_logarithms;
  row.terms = terms;
  rows_.push_back(row);
}

void PriorRows::add_of_sum(double factor, double target, double constant,
                           const std::vector<Weight>& weights) {
  Row row;
  row.kind = Row::Kind::of_sum;
  row.factor = factor;
  row.target = target;
  row.constant = constant;
  for (const Weight& w : weights) row.terms.push_back({w.number, w.weight});
  rows_.push_back(row);
}

void PriorRows::evaluate(const std::vector<double>& values, std::vector<double>& residuals,
                         std::vector<double>* jacobian) const {
  const std::size_t n = values.size();
  residuals.assign(rows_.size(), 0.0);
  if (jacobian != nullptr) jacobian->assign(rows_.size() * n, 0.0);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Row& row = rows_[r];
    const auto slope = [&](int number, double d) {
      if (jacobian != nullptr) (*jacobian)[r * n + number] += d;
    };
    if (row.kind == Row::Kind::of_number) {
      const int j = row.terms.front().number;
      residuals[r] = (values[j] - row.target) * row.factor;
      slope(j, row.factor);
    } else if (row.kind == Row::Kind::of_logarithms) {
      for (const LogTerm& t : row.terms) {
        residuals[r] += t.factor * std::log(values[t.number]);
        slope(t.number, t.factor / values[t.number]);
      }
    } else if (row.kind == Row::Kind::of_range) {
      double sum = row.constant;
      for (const LogTerm& t : row.terms) sum += t.factor * std::log(values[t.number]);
      if (sum >= row.least && sum <= row.most) continue;
      residuals[r] = row.factor * (sum - (sum < row.least ? row.least : row.most));
      for (const LogTerm& t : row.terms) slope(t.number, row.factor * t.factor / values[t.number]);
    } else {
      double sum = row.constant;
      for (const LogTerm& t : row.terms) sum += t.factor * values[t.number];
      residuals[r] = row.factor * (std::log(sum) - row.target);
      for (const LogTerm& t : row.terms) slope(t.number, row.factor * t.factor / sum);
    }
  }
}

}  // namespace vegard::fit
