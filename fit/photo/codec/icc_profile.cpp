#include "fit/photo/codec/icc_profile.h"

#include <lcms2.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "fit/photo/codec/light_curves.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit {
namespace icc_profile {

struct CloseContext {
  void operator()(cmsContext context) const { cmsDeleteContext(context); }
};
struct CloseProfile {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
struct CloseTransform {
  void operator()(void* transform) const { cmsDeleteTransform(transform); }
};
struct FreeCurve {
  void operator()(cmsToneCurve* curve) const { cmsFreeToneCurve(curve); }
};
using Profile = std::unique_ptr<void, CloseProfile>;

/// A context of its own, whose errors nobody prints.
class Context {
 public:
  Context() : context_(cmsCreateContext(nullptr, nullptr)) {
    if (context_ == nullptr) throw std::bad_alloc();
    cmsSetLogErrorHandlerTHR(context_.get(), [](cmsContext, cmsUInt32Number, const char*) {});
  }
  cmsContext get() const { return context_.get(); }

 private:
  std::unique_ptr<std::remove_pointer_t<cmsContext>, CloseContext> context_;
};

using Columns = std::array<std::array<double, 3>, 3>;

std::optional<ColourMatrix> inverse(const Columns& m) {
  const auto minor = [&](int a, int b, int c, int d) { return m[a][b] * m[c][d] - m[a][d] * m[c][b]; };
  const double determinant =
      m[0][0] * minor(1, 1, 2, 2) - m[0][1] * minor(1, 0, 2, 2) + m[0][2] * minor(1, 0, 2, 1);
  constexpr double kFlat = 1e-6;  // no light of three colours is so nearly of two
  if (!(std::abs(determinant) > kFlat)) return std::nullopt;
  ColourMatrix inv{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      inv[i][j] = (m[a][c] * m[b][d] - m[a][d] * m[b][c]) / determinant;
    }
  return inv;
}

ColourMatrix product(const ColourMatrix& a, const ColourMatrix& b) {
  ColourMatrix c{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

/// Rows X, Y, Z, columns red, green, blue, by the profile's colorants.
std::optional<Columns> colorants(cmsHPROFILE profile) {
  Columns m{};
  const cmsTagSignature tags[3] = {cmsSigRedColorantTag, cmsSigGreenColorantTag, cmsSigBlueColorantTag};
  for (int c = 0; c < 3; ++c) {
    const auto* xyz = static_cast<const cmsCIEXYZ*>(cmsReadTag(profile, tags[c]));
    if (xyz == nullptr) return std::nullopt;
    m[0][c] = xyz->X;
    m[1][c] = xyz->Y;
    m[2][c] = xyz->Z;
  }
  return m;
}

/// White to white exactly: a profile's colorants are rounded.
std::optional<ColourMatrix> to_srgb(const Columns& from) {
  const Profile srgb(cmsCreate_sRGBProfile());
  const auto target = srgb ? colorants(srgb.get()) : std::nullopt;
  const auto inv = target ? inverse(*target) : std::nullopt;
  if (!inv || !inverse(from)) return std::nullopt;
  ColourMatrix matrix = product(*inv, from);
  for (auto& row : matrix) {
    const double sum = row[0] + row[1] + row[2];
    if (!(std::abs(sum - 1.0) < 0.1)) return std::nullopt;
    for (double& one : row) one /= sum;
  }
  return matrix;
}

constexpr int kSamples = kCurveSamples;

/// Empty for a curve that falls anywhere.
std::vector<double> samples_of(const cmsToneCurve* curve) {
  std::vector<double> light(kSamples);
  for (int i = 0; i < kSamples; ++i)
    light[i] = std::clamp<double>(
        cmsEvalToneCurveFloat(curve, static_cast<float>(i) / static_cast<float>(kSamples - 1)), 0.0, 1.0);
  if (!std::is_sorted(light.begin(), light.end()) || !(light.back() > light.front())) return {};
  return light;
}

/// The curve under its own name where it has one.
LightCurve named_curve(const cmsToneCurve* curve, const std::vector<double>& light) {
  constexpr double kOfSrgb = 5e-4;
  double from_srgb = 0.0, from_linear = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double encoded = i / double{kSamples - 1};
    from_srgb = std::max(from_srgb, std::abs(light[i] - sim::srgb_decode(encoded)));
    from_linear = std::max(from_linear, std::abs(light[i] - encoded));
  }
  constexpr double kOfLinear = 1e-5;
  if (from_linear < kOfLinear) return {true, nullptr, "linear"};
  if (from_srgb < kOfSrgb) return {false, nullptr, "sRGB"};
  if (cmsGetToneCurveParametricType(curve) == 1) {
    // The exponent by the value of one half, exact for a power.
    const double gamma = std::log(static_cast<double>(cmsEvalToneCurveFloat(curve, 0.5f))) / std::log(0.5);
    const auto tone = std::make_shared<const sim::ToneCurve>(sim::ToneCurve::of_gamma(gamma));
    return {false, tone, tone->name()};
  }
  return {false, curve_of_samples(light, "the profile's curve"), "the profile's curve"};
}

class ProfileTable : public LightTable {
 public:
  /// Throws nothing; is_good() tells.
  explicit ProfileTable(std::string_view bytes) {
    const Profile from(
        cmsOpenProfileFromMemTHR(context_.get(), bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
    const cmsCIExyY d65 = {0.3127, 0.3290, 1.0};
    const cmsCIExyYTRIPLE primaries = {{0.64, 0.33, 1.0}, {0.30, 0.60, 1.0}, {0.15, 0.06, 1.0}};
    const std::unique_ptr<cmsToneCurve, FreeCurve> straight(cmsBuildGamma(context_.get(), 1.0));
    cmsToneCurve* const curves[3] = {straight.get(), straight.get(), straight.get()};
    const Profile to(cmsCreateRGBProfileTHR(context_.get(), &d65, &primaries, curves));
    if (!from || !to) return;
    transform_.reset(cmsCreateTransformTHR(context_.get(), from.get(), TYPE_RGB_FLT, to.get(), TYPE_RGB_FLT,
                                           INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOCACHE));
  }
  bool is_good() const { return transform_ != nullptr; }

  void to_light(const float* encoded, float* light, std::size_t pixels) const override {
    cmsDoTransform(transform_.get(), encoded, light, static_cast<cmsUInt32Number>(pixels));
  }

 private:
  Context context_;
  std::unique_ptr<void, CloseTransform> transform_;
};

std::string description_of(cmsHPROFILE profile) {
  char text[80] = {};
  cmsGetProfileInfoASCII(profile, cmsInfoDescription, "en", "US", text, sizeof text - 1);
  std::string name(text);
  for (char& c : name)
    if (c < 0x20 || c > 0x7e) c = '?';
  return name;
}

void take_curve(cmsHPROFILE profile, cmsTagSignature tag, DeclaredLight& light) {
  const auto* curve = static_cast<const cmsToneCurve*>(cmsReadTag(profile, tag));
  const std::vector<double> samples = curve != nullptr ? samples_of(curve) : std::vector<double>();
  if (samples.empty())
    light.problem = "its curve does not rise";
  else
    light.curve = named_curve(curve, samples);
}

/// Curves that differ between the colours are a table as well.
bool has_one_curve(cmsHPROFILE profile) {
  const cmsTagSignature tags[3] = {cmsSigRedTRCTag, cmsSigGreenTRCTag, cmsSigBlueTRCTag};
  const cmsToneCurve* curves[3] = {};
  for (int c = 0; c < 3; ++c) curves[c] = static_cast<const cmsToneCurve*>(cmsReadTag(profile, tags[c]));
  if (curves[0] == nullptr || curves[1] == nullptr || curves[2] == nullptr) return false;
  constexpr int kPlaces = 256;
  constexpr float kAlike = 1e-4f;
  for (int i = 0; i <= kPlaces; ++i) {
    const float x = static_cast<float>(i) / kPlaces, green = cmsEvalToneCurveFloat(curves[1], x);
    for (const int c : {0, 2})
      if (!(std::abs(cmsEvalToneCurveFloat(curves[c], x) - green) < kAlike)) return false;
  }
  return true;
}

void take_colours(cmsHPROFILE profile, std::string_view bytes, const std::string& name, bool is_grey,
                  DeclaredLight& light) {
  const bool is_plain = cmsIsMatrixShaper(profile) && has_one_curve(profile);
  if (is_plain || (is_grey && cmsIsMatrixShaper(profile))) {
    take_curve(profile, cmsSigGreenTRCTag, light);
    if (is_grey || !light.problem.empty()) return;
    const auto columns = colorants(profile);
    const auto matrix = columns ? to_srgb(*columns) : std::nullopt;
    if (!matrix) {
      light.problem = "its primaries span no triangle";
    } else if (!is_near_identity(*matrix)) {
      light.to_srgb = matrix;
      light.primaries = name;
    }
    return;
  }
  if (is_grey) {
    light.problem = "it is of tables for colours, and the picture is grey";
    return;
  }
  auto table = std::make_shared<ProfileTable>(bytes);
  if (table->is_good())
    light.table = std::move(table);
  else
    light.problem = "it has neither a curve and primaries nor a table";
}

}  // namespace icc_profile

void declare_profile(std::string_view bytes, bool is_grey, DeclaredLight& light) {
  using namespace icc_profile;
  light.source = "its ICC profile";
  if (bytes.size() > kMaxProfileBytes) {
    light.problem = "it is larger than 16 MB";
    light.words.emplace_back("ICC profile");
    return;
  }
  const Context context;
  const Profile profile(
      cmsOpenProfileFromMemTHR(context.get(), bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
  if (!profile) {
    light.problem = "it is damaged";
    light.words.emplace_back("ICC profile (damaged)");
    return;
  }
  const std::string name = description_of(profile.get());
  light.words.push_back("ICC profile \"" + name + "\"");
  light.source += " \"" + name + "\"";
  switch (cmsGetColorSpace(profile.get())) {
    case cmsSigRgbData:
      take_colours(profile.get(), bytes, name, is_grey, light);
      break;
    case cmsSigGrayData:
      take_curve(profile.get(), cmsSigGrayTRCTag, light);
      break;
    case cmsSigCmykData:
      light.problem = "it is of CMYK";
      break;
    default:
      light.problem = "it is neither of RGB nor of grey";
  }
}

std::optional<ColourMatrix> matrix_to_srgb(const Chromaticities& c) {
  using namespace icc_profile;
  const auto is_sound = [](const std::array<double, 2>& xy) {
    return std::isfinite(xy[0]) && std::isfinite(xy[1]) && std::abs(xy[0]) < 10.0 && std::abs(xy[1]) < 10.0 &&
           std::abs(xy[1]) > 1e-6;
  };
  if (!is_sound(c.red) || !is_sound(c.green) || !is_sound(c.blue) || !is_sound(c.white)) return std::nullopt;
  const cmsCIExyY white = {c.white[0], c.white[1], 1.0};
  const cmsCIExyYTRIPLE primaries = {
      {c.red[0], c.red[1], 1.0}, {c.green[0], c.green[1], 1.0}, {c.blue[0], c.blue[1], 1.0}};
  const Context context;
  const std::unique_ptr<cmsToneCurve, FreeCurve> straight(cmsBuildGamma(context.get(), 1.0));
  cmsToneCurve* const curves[3] = {straight.get(), straight.get(), straight.get()};
  const Profile profile(cmsCreateRGBProfileTHR(context.get(), &white, &primaries, curves));
  const auto columns = profile ? colorants(profile.get()) : std::nullopt;
  return columns ? to_srgb(*columns) : std::nullopt;
}

bool is_near_identity(const ColourMatrix& matrix) {
  constexpr double kHalfStep = 0.5 / 255.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::abs(matrix[i][j] - (i == j ? 1.0 : 0.0)) > kHalfStep) return false;
  return true;
}

}  // namespace vegard::fit
