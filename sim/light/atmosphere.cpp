#include "sim/light/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/base/embedded_table.h"

namespace vegard::sim {
namespace {

struct Row {
  double altitude_km = 0.0, temperature_k = 0.0, log_n2 = 0.0, log_o2 = 0.0, log_o = 0.0;
};

std::vector<Row> read_rows() {
  std::istringstream table{std::string(embedded_table("us76.csv"))};
  std::string line;
  std::getline(table, line);
  std::vector<Row> rows;
  while (std::getline(table, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    Row row;
    double n2 = 0.0, o2 = 0.0, o = 0.0;
    if (!(cells >> row.altitude_km >> row.temperature_k >> n2 >> o2 >> o))
      throw std::runtime_error("the table of the atmosphere has a short row");
    row.log_n2 = std::log(n2);
    row.log_o2 = std::log(o2);
    row.log_o = std::log(o);
    rows.push_back(row);
  }
  if (rows.size() < 2) throw std::runtime_error("the table of the atmosphere is empty");
  return rows;
}

}  // namespace

Air standard_air(double altitude_km) {
  static const std::vector<Row> rows = read_rows();
  const double h = std::clamp(altitude_km, rows.front().altitude_km, rows.back().altitude_km);
  const auto next = std::upper_bound(rows.begin() + 1, rows.end() - 1, h,
                                     [](double x, const Row& row) { return x < row.altitude_km; });
  const Row &below = *(next - 1), &above = *next;
  const double share = (h - below.altitude_km) / (above.altitude_km - below.altitude_km);
  const auto between = [&](double Row::*number) {
    return below.*number + (above.*number - below.*number) * share;
  };
  return {between(&Row::temperature_k), std::exp(between(&Row::log_n2)), std::exp(between(&Row::log_o2)),
          std::exp(between(&Row::log_o))};
}

}  // namespace vegard::sim
