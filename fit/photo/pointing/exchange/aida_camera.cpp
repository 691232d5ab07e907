#include "fit/photo/pointing/exchange/aida_camera.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kNumbersOfLine = 15;
constexpr std::size_t kMaxAidaCameras = 100000;
constexpr double kFarthestOffAxis_deg = 85.0;
constexpr int kAidaGridAcross = 40;

sim::Error bad_camera_line(const std::string& file, int line, const std::string& problem) {
  return sim::unreadable(file, problem).line(line);
}

std::vector<double> numbers_of_line(std::string_view line, const std::string& file, int line_number) {
  constexpr std::string_view kBlanks = " \t\r,";
  std::vector<double> numbers;
  for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;
       at = line.find_first_not_of(kBlanks, at)) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    std::string_view word = line.substr(at, end - at);
    if (word.front() == '+') word.remove_prefix(1);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size() || !std::isfinite(value))
      throw bad_camera_line(file, line_number, "'" + std::string(word) + "' is no number")
          .expected("fifteen numbers in a line");
    numbers.push_back(value);
    at = end;
  }
  return numbers;
}

AidaCamera camera_of_line(const std::vector<double>& n, const std::string& file, int line) {
  if (n.size() != kNumbersOfLine)
    throw bad_camera_line(file, line, std::to_string(n.size()) + " numbers")
        .expected("fifteen numbers in a line, as AIDA has them");
  AidaCamera camera;
  camera.station = n[0];
  camera.azimuth_deg = n[1];
  camera.zenith_deg = n[2];
  camera.from_jd = n[3];
  camera.until_jd = n[4];
  camera.line = line;
  const bool is_known = n[5] == 12.0 || (n[5] >= 1.0 && n[5] <= 5.0 && n[5] == std::floor(n[5]));
  if (!is_known)
    throw bad_camera_line(file, line, fmt::format("the lens's model {:g} is not read", n[5]))
        .expected("1 to 5, or 12");
  camera.model = static_cast<int>(n[5]);
  std::copy(n.begin() + 6, n.begin() + 14, camera.numbers.begin());
  if (camera.numbers[0] == 0.0 || camera.numbers[1] == 0.0)
    throw bad_camera_line(file, line, "a focal width is 0").expected("numbers other than 0");
  const double a = camera.numbers[7];
  if ((camera.model == 2 || camera.model == 4 || camera.model == 5) && !(std::abs(a) > 1e-6))
    throw bad_camera_line(file, line, fmt::format("the lens's number {:g} is none of its model's", a))
        .expected("a number other than 0");
  return camera;
}

/// R of the three angles, whose columns are the camera's axes.
template <class T>
Eigen::Matrix<T, 3, 3> aida_rotation(const T* degrees) {
  using std::cos, std::sin;
  const T a = degrees[0] * sim::kRadiansPerDegree, b = degrees[1] * sim::kRadiansPerDegree,
          c = degrees[2] * sim::kRadiansPerDegree;
  Eigen::Matrix<T, 3, 3> about_z, about_y, about_x;
  about_z << cos(c), -sin(c), T(0), sin(c), cos(c), T(0), T(0), T(0), T(1);
  about_y << cos(a), T(0), sin(a), T(0), T(1), T(0), -sin(a), T(0), cos(a);
  about_x << T(1), T(0), T(0), T(0), cos(b), sin(b), T(0), -sin(b), cos(b);
  return about_y * about_x * about_z;
}

/// Returns the distance from the axis, over f, at the angle theta.
template <class T>
T aida_radius(int model, const T& theta, const T& a) {
  using std::pow, std::sin, std::tan;
  switch (model) {
    case 1:
      return tan(theta);
    case 2:
      return sin(a * theta);
    case 3:
      return a * theta + (T(1) - a) * tan(theta);
    case 4:
      return pow(theta, a);
    case 5:
      return tan(a * theta);
    default:
      if (a > T(0)) return tan(a * theta) / a;
      if (a < T(0)) return sin(a * theta) / a;
      return theta;
  }
}

/// Over the picture's width and height.
template <class T>
void aida_project(int model, const T* n, const Eigen::Vector3d& enu, T& u, T& v) {
  using std::atan2, std::sqrt;
  const Eigen::Matrix<T, 3, 1> own = aida_rotation(n + 2).transpose() * enu.cast<T>();
  const T square = own.x() * own.x() + own.y() * own.y();
  u = T(0.5) + n[5];
  v = T(0.5) + n[6];
  if (square < T(1e-24)) return;
  const T rho = sqrt(square), over = aida_radius(model, T(atan2(rho, own.z())), n[7]) / rho;
  u += n[0] * own.x() * over;
  v += n[1] * own.y() * over;
}

/// The angle from the axis at which light is seen that far from it; NaN beyond the model's image.
double aida_angle(int model, double radius, double a) {
  switch (model) {
    case 1:
      return std::atan(radius);
    case 2:
      return std::asin(radius) / a;
    case 3: {
      // The left side grows with theta where a is between 0 and 1; Newton's steps from below the pole.
      double theta = std::atan(radius);
      constexpr int kMaxSteps = 60;
      for (int i = 0; i < kMaxSteps; ++i) {
        const double cosine = std::cos(theta);
        const double step = (aida_radius(3, theta, a) - radius) / (a + (1.0 - a) / (cosine * cosine));
        theta -= step;
        if (std::abs(step) < 1e-14) return theta;
      }
      return sim::kNaN;
    }
    case 4:
      return std::pow(radius, 1.0 / a);
    case 5:
      return std::atan(radius) / a;
    default:
      if (a > 0.0) return std::atan(a * radius) / a;
      if (a < 0.0) return std::asin(a * radius) / a;
      return radius;
  }
}

/// A place of the picture, and where it looks.
struct AidaPoint {
  double x_px = 0.0, y_px = 0.0;
  Eigen::Vector3d enu;
};

struct AidaCost {
  int model;
  double width_px, height_px;
  AidaPoint point;

  template <class T>
  bool operator()(const T* numbers, T* left) const {
    T u, v;
    aida_project(model, numbers, point.enu, u, v);
    left[0] = u * width_px - T(0.5) - T(point.x_px);
    left[1] = v * height_px - T(0.5) - T(point.y_px);
    return true;
  }
};

/// The numbers with which the search begins: the camera's own rotation, and the scale on its axis.
std::array<double, 8> first_numbers(int model, const sim::CameraView<double>& view,
                                    const sim::Camera& camera) {
  constexpr double kStartOfModel[] = {0.0, 0.0, 0.5, 0.35, 1.0, 0.5};
  const double a = kStartOfModel[model];
  const double slope = model == 2 || model == 5 ? a : 1.0;  // of g on the axis
  Eigen::Matrix3d axes;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) axes(j, i) = view.camera_from_enu[i][j];
  const auto degrees = [](double radians) { return radians / sim::kRadiansPerDegree; };
  return {view.lens.side * view.lens.focal_px / slope / camera.width,
          view.lens.focal_px * view.lens.aspect / slope / camera.height,
          degrees(std::atan2(axes(0, 2), axes(2, 2))),
          degrees(std::asin(std::clamp(axes(1, 2), -1.0, 1.0))),
          degrees(std::atan2(axes(1, 0), axes(1, 1))),
          view.lens.principal_x_px / camera.width - 0.5,
          view.lens.principal_y_px / camera.height - 0.5,
          a};
}

AidaFit fitted_model(int model, const sim::Camera& camera, const sim::CameraView<double>& view,
                     const std::vector<AidaPoint>& points) {
  AidaFit fit;
  fit.camera.model = model;
  fit.camera.numbers = first_numbers(model, view, camera);
  double* numbers = fit.camera.numbers.data();
  ceres::Problem problem;
  for (const AidaPoint& point : points)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<AidaCost, 2, 8>(new AidaCost{
            model, static_cast<double>(camera.width), static_cast<double>(camera.height), point}),
        nullptr, numbers);
  // a is held: the scale of theta^a on the axis is finite for a = 1 alone, and the pinhole has no a.
  if (model == 1 || model == 4) problem.SetManifold(numbers, new ceres::SubsetManifold(8, {7}));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = options.parameter_tolerance = options.gradient_tolerance = 1e-15;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  double sum = 0.0;
  for (const AidaPoint& point : points) {
    double left[2];
    AidaCost{model, static_cast<double>(camera.width), static_cast<double>(camera.height), point}(numbers,
                                                                                                  left);
    const double off = std::hypot(left[0], left[1]);
    sum += off * off;
    fit.largest_px = std::max(fit.largest_px, off);
  }
  fit.points = static_cast<int>(points.size());
  fit.rms_px = std::sqrt(sum / static_cast<double>(points.size()));
  return fit;
}

double julian_day(int year, int month, int day) {
  // Fliegel and Van Flandern 1968 (Communications of the ACM 11, 657), at 0 h.
  const long m = (month - 14) / 12;
  const long number = day - 32075L + 1461L * (year + 4800L + m) / 4 + 367L * (month - 2 - m * 12) / 12 -
                      3L * ((year + 4900L + m) / 100) / 4;
  return static_cast<double>(number) - 0.5;
}

/// Returns the Julian date some months later; days beyond the month's end count into the next month.
double months_later(double julian_date, int months) {
  // The inverse of the same paper.
  long l = static_cast<long>(std::floor(julian_date + 0.5)) + 68569;
  const long n = 4 * l / 146097;
  l -= (146097 * n + 3) / 4;
  const long i = 4000 * (l + 1) / 1461001;
  l = l - 1461 * i / 4 + 31;
  const long j = 80 * l / 2447;
  const int day = static_cast<int>(l - 2447 * j / 80);
  const long k = j / 11;
  const int month = static_cast<int>(j + 2 - 12 * k) - 1 + months;
  const int year = static_cast<int>(100 * (n - 49) + i + k) + (month >= 0 ? month : month - 11) / 12;
  return julian_day(year, (month % 12 + 12) % 12 + 1, 1) + day - 1;
}

}  // namespace

std::vector<AidaCamera> read_aida_cameras(std::string_view text, const std::string& file) {
  std::vector<AidaCamera> cameras;
  int line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    ++line_number;
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '%') continue;
    cameras.push_back(camera_of_line(numbers_of_line(line, file, line_number), file, line_number));
    if (cameras.size() > kMaxAidaCameras)
      throw bad_camera_line(file, line_number, "too many cameras").expected("at most 100000");
  }
  if (cameras.empty())
    throw bad_camera_line(file, 0, "there is no camera in it").expected("fifteen numbers in a line");
  return cameras;
}

bool aida_place(const AidaCamera& camera, int width_px, int height_px, const std::array<double, 3>& enu,
                double& x_px, double& y_px) {
  const Eigen::Vector3d direction(enu[0], enu[1], enu[2]);
  if (aida_rotation(camera.numbers.data() + 2).col(2).dot(direction) <= 0.0) return false;
  double u = 0.0, v = 0.0;
  aida_project(camera.model, camera.numbers.data(), direction, u, v);
  x_px = u * width_px - 0.5;
  y_px = v * height_px - 0.5;
  return true;
}

sim::DirectionMap directions_of_aida(const AidaCamera& camera, int width_px, int height_px) {
  const std::array<double, 8>& n = camera.numbers;
  const Eigen::Matrix3d axes = aida_rotation(n.data() + 2);
  constexpr double kQuarterTurn = 0.5 * sim::kPi;
  sim::DirectionMap map;
  map.width = width_px;
  map.height = height_px;
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      // Columns and rows from 1.
      const double across = ((x + 1.0) / width_px - 0.5 - n[5]) / n[0],
                   down = ((y + 1.0) / height_px - 0.5 - n[6]) / n[1], radius = std::hypot(across, down);
      double theta = aida_angle(camera.model, radius, n[7]);
      if (!(std::abs(theta) < kQuarterTurn)) theta = sim::kNaN;
      const double over = radius > 0.0 ? std::sin(theta) / radius : 0.0;
      const Eigen::Vector3d enu = axes * Eigen::Vector3d(over * across, over * down, std::cos(theta));
      const bool is_somewhere = std::isfinite(theta);
      const sim::Direction direction =
          is_somewhere ? sim::direction_of_enu(enu.data()) : sim::Direction{sim::kNaN, sim::kNaN};
      map.azimuth_deg.push_back(static_cast<float>(direction.azimuth_deg));
      map.elevation_deg.push_back(static_cast<float>(direction.elevation_deg));
    }
  return map;
}

AidaFit aida_of_camera(const sim::Camera& camera, std::optional<double> julian_date) {
  const sim::CameraView<double> view = sim::camera_view(camera);
  const Eigen::Vector3d axis(view.camera_from_enu[2][0], view.camera_from_enu[2][1],
                             view.camera_from_enu[2][2]);
  const double nearest = std::cos(kFarthestOffAxis_deg * sim::kRadiansPerDegree);
  std::vector<AidaPoint> points;
  int places = 0;
  const double step =
      std::max(1.0, std::max(camera.width, camera.height) / static_cast<double>(kAidaGridAcross));
  for (double y = 0.5 * step; y < camera.height; y += step)
    for (double x = 0.5 * step; x < camera.width; x += step) {
      ++places;
      AidaPoint point{x, y, {}};
      if (sim::enu_of_pixel(view, x, y, point.enu.data()) && point.enu.dot(axis) >= nearest)
        points.push_back(point);
    }
  constexpr std::size_t kFewest = 30;
  if (points.size() < kFewest)
    throw sim::Error(sim::ErrorKind::scene, "too little of the picture looks at the sky")
        .key("camera")
        .expected("a picture of the sky");
  AidaFit best;
  for (const int model : {1, 2, 3, 4, 5}) {
    const AidaFit fit = fitted_model(model, camera, view, points);
    if (std::isfinite(fit.rms_px) && (best.points == 0 || fit.rms_px < best.rms_px)) best = fit;
  }
  best.share = static_cast<double>(points.size()) / places;
  const sim::Direction direction = sim::direction_of_enu(axis.data());
  best.camera.azimuth_deg = direction.azimuth_deg;
  best.camera.zenith_deg = 90.0 - direction.elevation_deg;
  constexpr int kMonthsBefore = 4, kMonthsAfter = 6;
  constexpr double kForEver = 9999999.0;
  best.camera.from_jd = julian_date ? months_later(*julian_date, -kMonthsBefore) : 0.0;
  best.camera.until_jd = julian_date ? months_later(*julian_date, kMonthsAfter) : kForEver;
  return best;
}

std::string encode_aida(const AidaCamera& camera) {
  std::string line;
  const auto add = [&](double value) { line += fmt::format("  {: .16e}", value); };
  for (const double value : {camera.station, camera.azimuth_deg, camera.zenith_deg, camera.from_jd,
                             camera.until_jd, static_cast<double>(camera.model)})
    add(value);
  for (const double value : camera.numbers) add(value);
  add(0.0);
  return line + "\n";
}

}  // namespace vegard::fit
