#include "sim/view/colour/sensor_response.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/structs/sensor.h"
#include "sim/scene/table/table_files.h"
#include "sim/view/colour/colour.h"

namespace vegard::sim {
namespace {

constexpr double kFilterHalfBase_nm = 5.0;
constexpr const char* kResponseChannels[3] = {"red", "green", "blue"};

/// Calls use(wavelength_nm, power of daylight) at each step of a sum; the tables of light and observer are no
/// finer.
template <class Use>
void for_each_nm(const Use& use) {
  for (double nm = 380.0; nm <= 780.0; nm += 5.0) use(nm, daylight_power(nm, kD65Temperature_k));
}

CsvTable table_of(const Scene& scene) {
  const std::string& response = scene.sensor.response;
  if (!is_table_file(response)) return embedded_csv_table(response + ".csv");
  return read_csv_table(table_text(scene, "sensor.response"), table_place(scene, response));
}

ChannelTable channels_of(const Scene& scene) {
  const CsvTable table = table_of(scene);
  const bool per_photon =
      is_table_file(scene.sensor.response) && scene.sensor.response_per == ResponsePer::photon;
  ChannelTable channels;
  table.require_increasing("wavelength_nm");
  table.require_within("wavelength_nm", 100.0, 10000.0);
  channels.wavelength_nm = table.column("wavelength_nm");
  for (int c = 0; c < 3; ++c) {
    table.require_within(kResponseChannels[c], 0.0, 1e30);
    channels.response[c] = table.column(kResponseChannels[c]);
    if (per_photon)
      for (std::size_t i = 0; i < table.rows(); ++i) channels.response[c][i] *= channels.wavelength_nm[i];
  }
  const double green = channels.at(kGreenNm)[1];
  if (!(green > 0.0))
    throw unreadable(table.name, "the green channel has no response at 557.7 nm")
        .key("sensor.response")
        .expected("one above 0: it sets the scale of the gain");
  const double scale = colour_matching(kGreenNm)[1] / green;
  for (std::vector<double>& channel : channels.response)
    for (double& value : channel) value *= scale;
  return channels;
}

Matrix3 rgb_of_raw(const ChannelTable& channels, const Sensor& sensor) {
  const bool daylight = sensor.white_balance_rule == WhiteBalanceRule::daylight;
  const Matrix3 balance = diagonal(daylight ? daylight_balance(channels) : sensor.white_balance);
  if (sensor.matrix_rule == MatrixRule::none) return balance;
  if (sensor.matrix_rule == MatrixRule::colorimetric)
    return product(colorimetric_matrix(channels, sensor.primaries), balance);
  Matrix3 given;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) given[r][c] = sensor.matrix[3 * r + c];
  return product(given, balance);
}

std::size_t filters(const Scene& scene) { return std::min<std::size_t>(3, scene.emission.lines.size()); }

/// Returns where a kernel falls through half of its height, from its peak in steps of `direction`, in grid
/// steps.
double half_height(const std::vector<double>& kernel, int peak, int direction) {
  const double half = 0.5 * kernel[peak];
  const int count = static_cast<int>(kernel.size());
  int i = peak;
  while (i + direction >= 0 && i + direction < count && kernel[i + direction] > half) i += direction;
  if (i + direction < 0 || i + direction >= count) return i;
  return i + direction * (kernel[i] - half) / (kernel[i] - kernel[i + direction]);
}

}  // namespace

Vector3 ChannelTable::at(double nm) const {
  if (nm < wavelength_nm.front() || nm > wavelength_nm.back()) return {};
  const auto above = std::upper_bound(wavelength_nm.begin(), wavelength_nm.end(), nm);
  const std::size_t i = std::min<std::size_t>(above - wavelength_nm.begin(), wavelength_nm.size() - 1);
  if (i == 0) return {response[0][0], response[1][0], response[2][0]};  // a table of one row
  const double t = (nm - wavelength_nm[i - 1]) / (wavelength_nm[i] - wavelength_nm[i - 1]);
  Vector3 result;
  for (int c = 0; c < 3; ++c) result[c] = response[c][i - 1] + t * (response[c][i] - response[c][i - 1]);
  return result;
}

Vector3 daylight_balance(const ChannelTable& channels) {
  Vector3 sum{};
  for_each_nm([&](double nm, double power) {
    const Vector3 response = channels.at(nm);
    for (int c = 0; c < 3; ++c) sum[c] += power * response[c];
  });
  Vector3 gains;
  for (int c = 0; c < 3; ++c) gains[c] = sum[c] > 0.0 ? sum[1] / sum[c] : 1.0;
  return gains;
}

Matrix3 colorimetric_matrix(const ChannelTable& channels, Primaries primaries) {
  const Vector3 balance = daylight_balance(channels);
  const Matrix3 from_xyz = rgb_from_xyz(primaries);
  double white_luminance = 0.0, white_green = 0.0;
  for_each_nm([&](double nm, double power) {
    white_luminance += power * colour_matching(nm)[1];
    white_green += power * channels.at(nm)[1];
  });
  // A row (a, b, 1 - a - b) keeps white; what is left to find are a and b of each of the three.
  double square[2][2] = {}, mixed[3][2] = {};
  const auto learn = [&](const Vector3& raw, const Vector3& xyz) {
    Vector3 balanced, scaled;
    for (int c = 0; c < 3; ++c) {
      balanced[c] = raw[c] * balance[c] / white_green;
      scaled[c] = xyz[c] / white_luminance;
    }
    const Vector3 wanted = product(from_xyz, scaled);
    const double slope[2] = {balanced[0] - balanced[2], balanced[1] - balanced[2]};
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) square[i][j] += slope[i] * slope[j];
      for (int row = 0; row < 3; ++row) mixed[row][i] += slope[i] * (wanted[row] - balanced[2]);
    }
  };
  for (double centre = 400.0; centre <= 700.0; centre += 20.0) {
    for (const double sigma : {15.0, 30.0, 60.0}) {
      Vector3 raw{}, xyz{}, rest_raw{}, rest_xyz{};
      for_each_nm([&](double nm, double power) {
        const double band = std::exp(-0.5 * (nm - centre) * (nm - centre) / (sigma * sigma));
        const Vector3 response = channels.at(nm), matching = colour_matching(nm);
        for (int c = 0; c < 3; ++c) {
          raw[c] += power * band * response[c];
          xyz[c] += power * band * matching[c];
          rest_raw[c] += power * (1.0 - band) * response[c];
          rest_xyz[c] += power * (1.0 - band) * matching[c];
        }
      });
      learn(raw, xyz);
      learn(rest_raw, rest_xyz);
    }
  }
  const double determinant = square[0][0] * square[1][1] - square[0][1] * square[1][0];
  // Channels that are all alike have no colour to find: their light stays grey.
  if (!(determinant > 1e-12 * square[0][0] * square[1][1])) return kIdentity3;
  Matrix3 matrix;
  for (int row = 0; row < 3; ++row) {
    const double a = (mixed[row][0] * square[1][1] - mixed[row][1] * square[0][1]) / determinant;
    const double b = (mixed[row][1] * square[0][0] - mixed[row][0] * square[1][0]) / determinant;
    matrix[row] = {a, b, 1.0 - a - b};
  }
  return matrix;
}

bool sees_through_filters(const Scene& scene) {
  return response_kind(scene.sensor.response) == ResponseKind::filters;
}

std::vector<Vector3> filter_colours(const Scene& scene) {
  std::vector<Vector3> colours(scene.emission.lines.size(), Vector3{});
  for (std::size_t i = 0; i < filters(scene); ++i) colours[i][i] = 1.0;
  return colours;
}

ChannelTable filter_channels(const Scene& scene) {
  ChannelTable table;
  std::vector<double>& nm = table.wavelength_nm;
  for (std::size_t i = 0; i < filters(scene); ++i)
    for (const double offset : {-kFilterHalfBase_nm, 0.0, kFilterHalfBase_nm})
      nm.push_back(scene.emission.lines[i] + offset);
  std::sort(nm.begin(), nm.end());
  nm.erase(std::unique(nm.begin(), nm.end()), nm.end());
  for (std::size_t c = 0; c < 3; ++c)
    for (const double at : nm) {
      const double line = c < filters(scene) ? scene.emission.lines[c] : 0.0;
      // Responses are per power, and a photon of a longer wave has less of it.
      const double per_photon = colour_matching(kGreenNm)[1] * at / kGreenNm;
      table.response[c].push_back(per_photon * std::max(0.0, 1.0 - std::abs(at - line) / kFilterHalfBase_nm));
    }
  return table;
}

SensorResponse::SensorResponse(const Scene& scene)
    : is_cie_(response_kind(scene.sensor.response) == ResponseKind::cie),
      is_grey_(response_kind(scene.sensor.response) == ResponseKind::grey) {
  if (is_grey_) {
    rgb_from_channels_ = kIdentity3;
    return;
  }
  if (is_cie_) {
    rgb_from_channels_ = rgb_from_xyz(scene.sensor.primaries);
    return;
  }
  const bool filters = sees_through_filters(scene);
  table_ = filters ? filter_channels(scene) : channels_of(scene);
  if (table_.wavelength_nm.empty()) table_.wavelength_nm = {kGreenNm}, table_.response.fill({0.0});
  first_nm_ = table_.wavelength_nm.front();
  last_nm_ = table_.wavelength_nm.back();
  if (filters) {
    rgb_from_channels_ = kIdentity3;
    return;
  }
  rgb_from_raw_ = rgb_of_raw(table_, scene.sensor);
  constexpr double kMinDeterminant = 1e-9;
  // Not the other way round: what is no number is refused too.
  if (!(relative_determinant(rgb_from_raw_) > kMinDeterminant)) {
    const bool is_given = scene.sensor.matrix_rule == MatrixRule::given;
    const char* const key = is_given ? "sensor.matrix" : "sensor.response";
    throw Error(ErrorKind::scene, is_given ? "the matrix has no inverse: two colours would become one"
                                           : "the three channels do not tell three colours apart")
        .file(scene.file)
        .line(line_of(scene, key))
        .key(key)
        .expected(is_given ? "rows that are no multiples or sums of each other"
                           : "red, green and blue channels that differ, none of them dark");
  }
  rgb_from_channels_ = rgb_from_raw_;
}

Vector3 SensorResponse::channels_of_power(double wavelength_nm) const {
  if (is_grey_) {
    const double per_photon = colour_matching(kGreenNm)[1] * wavelength_nm / kGreenNm;
    return {per_photon, per_photon, per_photon};
  }
  return is_cie_ ? colour_matching(wavelength_nm) : table_.at(wavelength_nm);
}

Vector3 SensorResponse::rgb_per_kilorayleigh(double wavelength_nm) const {
  Vector3 rgb = product(rgb_from_channels_, channels_of_power(wavelength_nm));
  // A rayleigh counts photons, whose energy falls with their wavelength.
  for (double& channel : rgb) channel *= (kGreenNm / wavelength_nm) / colour_matching(kGreenNm)[1];
  return rgb;
}

ResolvingKernel resolving_kernel(const SensorResponse& response, double wavelength_nm) {
  std::vector<Eigen::Vector3d> channels;
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (double nm = response.first_nm(); nm <= response.last_nm(); nm += 1.0) {
    const Vector3 per_power = response.channels_of_power(nm);
    channels.emplace_back(per_power[0] / nm, per_power[1] / nm, per_power[2] / nm);
    area += channels.back();
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < channels.size(); ++i) {
    channels[i] = channels[i].cwiseQuotient(area);
    const double away = response.first_nm() + static_cast<double>(i) - wavelength_nm;
    spread += 12.0 * away * away * channels[i] * channels[i].transpose();
  }
  // All areas are 1, and so is the sum of the weights.
  const Eigen::Vector3d narrowest = spread.ldlt().solve(Eigen::Vector3d::Ones());
  const Eigen::Vector3d weights = narrowest / narrowest.sum();
  ResolvingKernel result;
  result.weights = {weights(0), weights(1), weights(2)};
  result.spread_nm = weights.dot(spread * weights);
  std::vector<double> kernel;
  for (const Eigen::Vector3d& channel : channels) kernel.push_back(weights.dot(channel));
  const int peak = static_cast<int>(std::max_element(kernel.begin(), kernel.end()) - kernel.begin());
  result.peak_nm = response.first_nm() + peak;
  result.fwhm_nm = half_height(kernel, peak, 1) - half_height(kernel, peak, -1);
  return result;
}

}  // namespace vegard::sim
