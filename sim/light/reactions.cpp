#include "sim/light/reactions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <initializer_list>

#include "sim/base/data_folders.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"

namespace vegard::sim {
namespace {

constexpr double kRoomK = 300.0, kHotElectronsK = 1200.0;

bool is_one_of(int number, std::initializer_list<Reaction> reactions) {
  return std::any_of(reactions.begin(), reactions.end(),
                     [&](Reaction reaction) { return static_cast<int>(reaction) == number; });
}

/// Returns whether a rate must be above 0: of recombination, without which ions stay for ever, and of the
/// light of metastable atoms, by which they are counted.
bool must_be_positive(int number) {
  using R = Reaction;
  return is_one_of(number, {R::n2p_e, R::o2p_e_cold, R::o2p_e_hot, R::nop_e_cold, R::nop_e_hot, R::n2a_light,
                            R::o1s_5577, R::o1d_6300, R::n2d_5200, R::op2p_light_2d});
}

bool is_share(int number) {
  using R = Reaction;
  return is_one_of(number, {R::np_share, R::op_share, R::np_to_nop, R::np_to_o2p, R::np_to_op, R::light_4278,
                            R::light_3371, R::light_6705, R::b_of_w});
}

}  // namespace

void Reactions::read(const std::string& csv, const std::string& name, bool may_add) {
  const CsvTable table = read_csv_table(csv, name);
  const auto &numbers = table.column("number"), &values = table.column("value"),
             &exponents = table.column("exponent"), &activations = table.column("activation_K"),
             &of = table.column("of");
  table.require_within("exponent", -10.0, 10.0);
  table.require_within("activation_K", -1e4, 1e5);
  table.require_within("of", 0.0, 2.0);
  for (std::size_t r = 0; r < table.rows(); ++r) {
    if (!(numbers[r] >= 0.0 && numbers[r] < kReactionNumbers) || numbers[r] != std::floor(numbers[r]))
      throw table.bad_row(r, "there is no reaction of this number")
          .expected("a number of data/electrons/reactions.csv");
    const int number = static_cast<int>(numbers[r]), by = static_cast<int>(of[r]);
    const auto known = rows_.find(number);
    if (!may_add && known == rows_.end())
      throw table.bad_row(r, "there is no reaction of this number")
          .expected("a number of data/electrons/reactions.csv");
    if (values[r] < 0.0) throw table.bad_row(r, "the value is negative").expected("0 or more");
    if (must_be_positive(number) && values[r] == 0.0)
      throw table.bad_row(r, "the value is 0, and nothing else would end what it ends")
          .expected("a value above 0");
    if (is_share(number) && values[r] > 1.0) throw table.bad_row(r, "a share is above 1").expected("0 to 1");
    if (by != of[r] || (!may_add && by != known->second.of))
      throw table.bad_row(r, "the column `of` is not that of the reaction")
          .expected(
              "0 (a value alone), 1 (by the air's temperature) or 2 (by the electrons'), as the reaction "
              "has it");
    rows_[number] = {values[r], exponents[r], activations[r], by};
  }
  constexpr double kRounding = 1e-9;
  if (std::abs(value(Reaction::np_to_nop) + value(Reaction::np_to_o2p) + value(Reaction::np_to_op) - 1.0) >
      kRounding)
    throw unreadable(name, "the shares of N+ + O2, numbers 82 to 84, do not add up to 1")
        .expected("all three in the table, with a sum of 1");
}

const Reactions& Reactions::standard() {
  static const Reactions reactions = [] {
    Reactions read;
    read.read(std::string(embedded_table("reactions.csv")), "reactions.csv", true);
    return read;
  }();
  return reactions;
}

Reactions Reactions::changed(const std::string& csv, const std::string& name) {
  Reactions reactions = standard();
  reactions.read(csv, name, false);
  return reactions;
}

Reactions Reactions::scaled(const std::map<int, double>& factor_of_number) const {
  Reactions reactions = *this;
  for (const auto& [number, factor] : factor_of_number) {
    Row& row = reactions.rows_.at(number);
    row.value *= factor;
    if (is_share(number)) row.value = std::min(1.0, row.value);
  }
  double sum = 0.0;
  constexpr std::array kParts = {Reaction::np_to_nop, Reaction::np_to_o2p, Reaction::np_to_op};
  for (const Reaction part : kParts) sum += reactions.value(part);
  for (const Reaction part : kParts) reactions.rows_.at(static_cast<int>(part)).value /= sum;
  return reactions;
}

RatesAtPlace Reactions::at(double temperature_k, double electron_temperature_k) const {
  std::array<double, kReactionNumbers> rates{};
  for (const auto& [number, row] : rows_) {
    double& rate = rates[static_cast<std::size_t>(number)];
    rate = row.value;
    if (row.of == 0) continue;
    const double temperature = row.of == 1 ? temperature_k : electron_temperature_k;
    rate *= std::pow(temperature / kRoomK, row.exponent) * std::exp(-row.activation_k / temperature);
  }
  return {rates, electron_temperature_k >= kHotElectronsK};
}

double Reactions::rate(Reaction reaction, double temperature_k) const {
  const Row& row = rows_.at(static_cast<int>(reaction));
  assert(row.of == 1);
  return row.value * std::pow(temperature_k / kRoomK, row.exponent) *
         std::exp(-row.activation_k / temperature_k);
}

double Reactions::value(Reaction reaction) const {
  const Row& row = rows_.at(static_cast<int>(reaction));
  assert(row.of == 0);
  return row.value;
}

}  // namespace vegard::sim
