#include "sim/light/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/base/file/csv_table.h"

namespace vegard::sim {
namespace {

struct AirRow {
  double altitude_km = 0.0, temperature_k = 0.0, log_n2 = 0.0, log_o2 = 0.0, log_o = 0.0;
};

std::vector<AirRow> read_rows() {
  const CsvTable table = embedded_csv_table("us76.csv");
  std::vector<AirRow> rows;
  for (std::size_t r = 0; r < table.rows(); ++r)
    rows.push_back({table.numbers[0][r], table.numbers[1][r], std::log(table.numbers[2][r]),
                    std::log(table.numbers[3][r]), std::log(table.numbers[4][r])});
  return rows;
}

}  // namespace

Air standard_air(double altitude_km) {
  static const std::vector<AirRow> rows = read_rows();
  const double h = std::clamp(altitude_km, rows.front().altitude_km, rows.back().altitude_km);
  const auto next = std::upper_bound(rows.begin() + 1, rows.end() - 1, h,
                                     [](double x, const AirRow& row) { return x < row.altitude_km; });
  const AirRow &below = *(next - 1), &above = *next;
  const double share = (h - below.altitude_km) / (above.altitude_km - below.altitude_km);
  const auto between = [&](double AirRow::*number) {
    return below.*number + (above.*number - below.*number) * share;
  };
  return {between(&AirRow::temperature_k), std::exp(between(&AirRow::log_n2)),
          std::exp(between(&AirRow::log_o2)), std::exp(between(&AirRow::log_o))};
}

}  // namespace vegard::sim
