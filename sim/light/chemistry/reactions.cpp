#include "sim/light/chemistry/reactions.h"

#include <cassert>
#include <cmath>
#include <cstddef>

#include "sim/base/embedded_table.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"

namespace vegard::sim {
namespace {

constexpr double kRoomK = 300.0, kHotElectronsK = 1200.0;

[[noreturn]] void refuse_row(const CsvTable& table, std::size_t row, const std::string& problem,
                             const std::string& expected) {
  ErrorDetails details;
  details.file = table.name;
  details.line = table.lines[row];
  details.problem = problem;
  details.expected = expected;
  throw Error(ErrorKind::unreadable_input, details);
}

}  // namespace

void Reactions::read(const std::string& csv, const std::string& name, bool may_add) {
  const CsvTable table = read_csv_table(csv, name);
  const auto &numbers = table.column("number"), &values = table.column("value"),
             &exponents = table.column("exponent"), &activations = table.column("activation_K"),
             &of = table.column("of");
  table.require_within("exponent", -10.0, 10.0);
  table.require_within("activation_K", -1e4, 1e5);
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const int number = static_cast<int>(numbers[r]), by = static_cast<int>(of[r]);
    const auto known = rows_.find(number);
    if (number < 0 || number >= kReactionNumbers || number != numbers[r] ||
        (!may_add && known == rows_.end()))
      refuse_row(table, r, "there is no reaction of this number", "a number of data/electrons/reactions.csv");
    if (values[r] < 0.0) refuse_row(table, r, "the value is negative", "0 or more");
    if (by < 0 || by > 2 || by != of[r] || (!may_add && by != known->second.of))
      refuse_row(
          table, r, "the column `of` is not that of the reaction",
          "0 (a value alone), 1 (by the air's temperature) or 2 (by the electrons'), as the reaction has it");
    rows_[number] = {values[r], exponents[r], activations[r], by};
  }
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

double Reactions::value(Reaction reaction) const {
  const Row& row = rows_.at(static_cast<int>(reaction));
  assert(row.of == 0);
  return row.value;
}

void Reactions::set(Reaction reaction, double value) { rows_.at(static_cast<int>(reaction)).value = value; }

}  // namespace vegard::sim
