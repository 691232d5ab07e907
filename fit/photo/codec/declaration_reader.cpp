#include "fit/photo/codec/declaration_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>

#include "fit/photo/codec/filmic_light.h"
#include "fit/photo/codec/icc_profile.h"
#include "fit/photo/codec/light_curves.h"
#include "sim/base/error.h"
#include "sim/base/file/byte_stream.h"
#include "sim/base/picture/exif_block.h"
#include "sim/base/picture/fits_header.h"
#include "sim/base/picture/heif_boxes.h"
#include "sim/base/picture/tiff_directory.h"
#include "sim/base/text.h"

namespace vegard::fit {
namespace declared {

using namespace std::string_view_literals;

constexpr std::array<double, 2> kD65 = {0.3127, 0.3290};

struct NamedPrimaries {
  const char* name;
  int h273;  ///< its number there; 0: none
  Chromaticities at;
};

/// ITU-T H.273, table 2, and Adobe RGB (1998) 4.3.1. The first is that of the program.
const std::vector<NamedPrimaries>& known_primaries() {
  static const std::vector<NamedPrimaries> all = {
      {"sRGB", 1, {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65}},
      {"Display P3", 12, {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kD65}},
      {"Rec. 2020", 9, {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kD65}},
      {"Adobe RGB", 0, {{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, kD65}},
      {"DCI-P3", 11, {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.314, 0.351}}},
      {"BT.470 M", 4, {{0.67, 0.33}, {0.21, 0.71}, {0.14, 0.08}, {0.310, 0.316}}},
      {"BT.470 B, G", 5, {{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, kD65}},
      {"SMPTE 170M", 6, {{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, kD65}},
      {"SMPTE 240M", 7, {{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, kD65}},
      {"film", 8, {{0.681, 0.319}, {0.243, 0.692}, {0.145, 0.049}, {0.310, 0.316}}},
      {"EBU 3213", 22, {{0.630, 0.340}, {0.295, 0.605}, {0.155, 0.077}, kD65}},
  };
  return all;
}

void declare_h273(int primaries, int transfer, DeclaredLight& light) {
  if (const auto at = primaries_of_h273(primaries)) declare_primaries(*at, light);
  light.curve = curve_of_h273(transfer);
}

/// What EXIF says: of Adobe RGB by DCF's R03 or by the number that some writers use for it. sRGB (1) is what
/// is assumed in any case.
void declare_exif(std::string_view tiff, DeclaredLight& light) {
  constexpr int kExifDirectory = 34665, kInterop = 40965, kColourSpace = 40961, kInteropIndex = 1,
                kGamma = 42240;
  const auto first = sim::TiffDirectory::first(tiff);
  const auto exif = first ? first->at_tag(kExifDirectory) : std::nullopt;
  if (!exif) return;
  const auto interop = exif->at_tag(kInterop);
  const bool is_adobe =
      (interop && interop->text(kInteropIndex) == "R03") || exif->number(kColourSpace) == 2.0;
  const auto gamma = exif->number(kGamma);
  if (is_adobe) {
    light.words.emplace_back("EXIF Adobe RGB (DCF R03)");
    if (light.counts()) return;
    light.source = "its EXIF, Adobe RGB";
    constexpr double kAdobeGamma = 563.0 / 256.0;  // Adobe RGB (1998), 4.3.1.2
    light.curve = gamma_curve(kAdobeGamma);
    declare_primaries(known_primaries()[3].at, light);
  } else if (gamma && *gamma > 0.0 && *gamma < 10.0) {
    light.words.push_back(fmt::format("EXIF Gamma {:g}", *gamma));
    if (light.counts() || exif->number(kColourSpace) == 1.0) return;
    light.source = "its EXIF Gamma";
    light.curve = gamma_curve(*gamma);
  }
}

/// ICC.1:2022, B.4: pieces in APP2 segments, each with its number and how many there are.
void declare_jpeg(std::string_view bytes, DeclaredLight& light) {
  constexpr int kStartOfScan = 0xda, kApp1 = 0xe1, kApp2 = 0xe2, kComment = 0xfe;
  constexpr std::string_view kProfile = "ICC_PROFILE\0"sv, kExif = "Exif\0\0"sv;
  std::vector<std::string_view> pieces;
  std::string_view exif, comment;
  bool is_grey = false, is_broken = false;
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    if (bytes[at] != '\xff') break;
    const int marker = static_cast<unsigned char>(bytes[at + 1]);
    if (marker == 0xff) {
      ++at;
      continue;
    }
    if (marker == kStartOfScan) break;
    const std::size_t length = sim::unsigned_at(bytes, at + 2, 2);
    if (length < 2 || length > bytes.size() - at - 2) break;
    const std::string_view segment = bytes.substr(at + 4, length - 2);
    at += 2 + length;
    const bool is_frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame && segment.size() > 5) is_grey = segment[5] == 1;
    if (marker == kApp1 && exif.empty() && segment.substr(0, kExif.size()) == kExif)
      exif = segment.substr(kExif.size());
    if (marker == kComment && comment.empty()) comment = segment;
    if (marker != kApp2 || segment.substr(0, kProfile.size()) != kProfile) continue;
    const std::string_view piece = segment.substr(kProfile.size());
    if (piece.size() < 2 || piece[0] == 0) {
      is_broken = true;
      continue;
    }
    const std::size_t number = static_cast<unsigned char>(piece[0]);
    if (pieces.size() < number) pieces.resize(number);
    pieces[number - 1] = piece.substr(2);
  }
  if (!pieces.empty() || is_broken) {
    std::string profile;
    for (const std::string_view piece : pieces) profile += piece;
    declare_profile(profile, is_grey, light);
  }
  declare_exif(exif, light);
  declare_filmic(filmic_words(comment), light);
}

double png_number(std::string_view data, std::size_t which) {
  constexpr double kUnit = 1e-5;
  return kUnit * static_cast<double>(sim::unsigned_at(data, 4 * which, 4));
}

struct PngChunks {
  std::string_view cicp, profile, gamma, chromaticities, exif, depth, encoding;
  bool is_srgb = false, is_grey = false;
};

PngChunks png_chunks(std::string_view bytes) {
  PngChunks chunks;
  constexpr std::size_t kColourType = 25;
  chunks.is_grey = bytes.size() > kColourType && (bytes[kColourType] & 2) == 0;
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = sim::unsigned_at(bytes, at, 4);
    if (length > bytes.size() - at - 12) break;
    const std::string_view type = bytes.substr(at + 4, 4), data = bytes.substr(at + 8, length);
    at += 12 + length;
    if (type == "IDAT" || type == "IEND") break;
    if (type == "cICP" && length == 4) chunks.cicp = data;
    if (type == "iCCP") chunks.profile = data;
    if (type == "sRGB" && length == 1) chunks.is_srgb = true;
    if (type == "gAMA" && length == 4) chunks.gamma = data;
    if (type == "cHRM" && length == 32) chunks.chromaticities = data;
    if (type == "eXIf") chunks.exif = data;
    if (constexpr std::string_view kEncoding = "vegard:encoding\0"sv;
        type == "tEXt" && data.substr(0, kEncoding.size()) == kEncoding)
      chunks.encoding = data.substr(kEncoding.size());
    if (type == "sBIT" && length > 0) chunks.depth = data;
  }
  return chunks;
}

/// Empty for a stream that does not unpack, or to more than kMaxProfileBytes.
std::string unpacked_profile(std::string_view data) {
  const std::size_t name = data.find('\0');
  if (name == std::string_view::npos || data.size() < name + 2 || data[name + 1] != 0) return {};
  try {
    sim::ByteStream stream = sim::ByteStream::of_zlib(data.substr(name + 2), "iCCP");
    std::string profile;
    std::array<char, 1 << 14> block{};
    while (const std::size_t got = stream.read(block.data(), block.size())) {
      profile.append(block.data(), got);
      if (profile.size() > kMaxProfileBytes) return {};
    }
    return profile;
  } catch (const sim::Error&) {
    return {};
  }
}

void declare_cicp(std::string_view data, DeclaredLight& light) {
  const int primaries = data[0], transfer = data[1], matrix = data[2], range = data[3];
  light.words.push_back(fmt::format("PNG cICP {}, {}, {}, {}", static_cast<unsigned char>(data[0]),
                                    static_cast<unsigned char>(data[1]), matrix, range));
  light.source = "its PNG cICP";
  if (matrix != 0 || range != 1) {
    light.problem = matrix != 0 ? "it is not of red, green and blue" : "it is of a narrow range of numbers";
    return;
  }
  declare_h273(primaries, transfer, light);
}

Chromaticities chromaticities_of(const std::function<double(std::size_t)>& number, bool white_first) {
  const std::size_t colour = white_first ? 2 : 0, white = white_first ? 0 : 6;
  return {{number(colour), number(colour + 1)},
          {number(colour + 2), number(colour + 3)},
          {number(colour + 4), number(colour + 5)},
          {number(white), number(white + 1)}};
}

void declare_png(std::string_view bytes, DeclaredLight& light) {
  const PngChunks chunks = png_chunks(bytes);
  if (!chunks.cicp.empty()) declare_cicp(chunks.cicp, light);
  if (!chunks.profile.empty()) {
    if (light.counts())
      light.words.emplace_back("ICC profile");
    else
      declare_profile(unpacked_profile(chunks.profile), chunks.is_grey, light);
  }
  if (chunks.is_srgb) {
    light.words.emplace_back("PNG sRGB");
    if (!light.counts()) light.curve = LightCurve{false, nullptr, "sRGB"}, light.source = "its PNG sRGB";
  }
  const bool is_open = !light.counts();
  const double gamma = chunks.gamma.empty() ? 0.0 : png_number(chunks.gamma, 0);
  if (gamma > 0.0) {
    light.words.push_back(fmt::format("PNG gAMA {:g}", gamma));
    if (is_open) light.curve = gamma_curve(1.0 / gamma), light.source = "its PNG gAMA";
  }
  if (!chunks.chromaticities.empty()) {
    const Chromaticities at =
        chromaticities_of([&](std::size_t i) { return png_number(chunks.chromaticities, i); }, true);
    light.words.push_back(
        fmt::format("PNG cHRM red {:g} {:g}, green {:g} {:g}, blue {:g} {:g}, white {:g} {:g}", at.red[0],
                    at.red[1], at.green[0], at.green[1], at.blue[0], at.blue[1], at.white[0], at.white[1]));
    if (is_open && !chunks.is_grey) {
      declare_primaries(at, light);
      if (light.to_srgb || !light.problem.empty())
        light.source = light.source.empty() ? "its PNG cHRM" : "its PNG gAMA and cHRM";
    }
  }
  if (!chunks.depth.empty()) {
    light.converter_bits = static_cast<unsigned char>(chunks.depth[0]);
    light.words.push_back(fmt::format("PNG sBIT {}", light.converter_bits));
  }
  declare_exif(chunks.exif, light);
  declare_filmic(chunks.encoding, light);
}

/// TIFF 6.0, section 20: light of each code, 0 to 65535.
void declare_transfer(const sim::TiffDirectory& directory, std::uint64_t bits, DeclaredLight& light) {
  constexpr int kTransferFunction = 301;
  if (!directory.has(kTransferFunction) || bits > 16) return;
  light.words.emplace_back("TIFF TransferFunction");
  if (light.counts()) return;
  const auto all = directory.values(kTransferFunction);
  const std::size_t codes = std::size_t{1} << bits;
  light.source = "its TIFF TransferFunction";
  if (!all || (all->size() != codes && all->size() != 3 * codes)) {
    light.problem = "it is not of one or three columns of all codes";
    return;
  }
  std::vector<double> samples;
  const double white = static_cast<double>((*all)[codes - 1]);
  for (std::size_t i = 0; i < codes; ++i) {
    for (std::size_t c = codes; c < all->size(); c += codes)
      if ((*all)[c + i] != (*all)[i]) light.problem = "its curves differ between the colours";
    samples.push_back(white > 0.0 ? static_cast<double>((*all)[i]) / white : 0.0);
  }
  if (!light.problem.empty()) return;
  if (!std::is_sorted(samples.begin(), samples.end()) || !(samples.back() > samples.front())) {
    light.problem = "its curve does not rise";
    return;
  }
  double from_linear = 0.0, from_srgb = 0.0;
  for (std::size_t i = 0; i < codes; ++i) {
    const double encoded = static_cast<double>(i) / static_cast<double>(codes - 1);
    from_linear = std::max(from_linear, std::abs(samples[i] - encoded));
    from_srgb = std::max(from_srgb, std::abs(samples[i] - sim::srgb_decode(encoded)));
  }
  constexpr double kRounding = 1.0 / 65535.0;  // of the table's numbers
  if (from_linear <= kRounding)
    light.curve = LightCurve{true, nullptr, "linear"};
  else if (from_srgb <= kRounding)
    light.curve = LightCurve{false, nullptr, "sRGB"};
  else
    light.curve = LightCurve{false, curve_of_samples(samples, "the TIFF's curve"), "the TIFF's curve"};
}

void declare_tiff(std::string_view bytes, DeclaredLight& light) {
  using namespace sim::tiff_tag;
  constexpr int kProfile = 34675, kWhite = 318, kPrimaries = 319, kMaxSample = 281;
  const sim::TiffDirectory directory(bytes);
  if (!directory.complete()) return;
  const bool is_grey = directory.value(kSamples, 1) < 3 && directory.value(kPhotometric, 1) != 3;
  if (const auto profile = directory.bytes(kProfile)) declare_profile(*profile, is_grey, light);
  const auto bits = directory.value(kBits, 1);
  const bool is_open = !light.counts();
  declare_transfer(directory, bits, light);
  const std::vector<double> primaries = directory.numbers(kPrimaries, 6),
                            white = directory.numbers(kWhite, 2);
  if (primaries.size() == 6) {
    light.words.push_back(
        fmt::format("TIFF PrimaryChromaticities red {:g} {:g}, green {:g} {:g}, blue {:g} {:g}", primaries[0],
                    primaries[1], primaries[2], primaries[3], primaries[4], primaries[5]));
    if (is_open && !is_grey) {
      const bool has_white = white.size() == 2;
      declare_primaries({{primaries[0], primaries[1]},
                         {primaries[2], primaries[3]},
                         {primaries[4], primaries[5]},
                         has_white ? std::array<double, 2>{white[0], white[1]} : kD65},
                        light);
      if (light.source.empty() && light.counts()) light.source = "its TIFF PrimaryChromaticities";
    }
  }
  if (const auto most = directory.number(kMaxSample))
    light.words.push_back(fmt::format("TIFF MaxSampleValue {:g}", *most));
  declare_exif(bytes, light);
  constexpr int kDescription = 270;
  if (const auto description = directory.text(kDescription))
    declare_filmic(filmic_words(description->substr(0, description->find('?'))), light);  // the first line
}

/// The properties colr of the main picture (ISO/IEC 14496-12, 12.1.5): an ICC profile before numbers of
/// H.273.
void declare_heif(std::string_view bytes, DeclaredLight& light) {
  for (const std::string_view colour : sim::heif_colours(bytes)) {
    const std::string_view kind = colour.substr(0, 4),
                           data = colour.substr(std::min<std::size_t>(4, colour.size()));
    if (kind == "prof" || kind == "rICC") {
      light = {};
      declare_profile(data, false, light);
    } else if (kind == "nclx" && data.size() >= 7 && light.words.empty()) {
      const int primaries = static_cast<int>(sim::unsigned_at(data, 0, 2)),
                transfer = static_cast<int>(sim::unsigned_at(data, 2, 2));
      light.words.push_back(fmt::format("HEIF colour {}, {}", primaries, transfer));
      light.source = "its HEIF colour";
      declare_h273(primaries, transfer, light);
    }
  }
  declare_exif(sim::heif_exif(bytes), light);
}

float little_float(std::string_view bytes, std::size_t at) {
  const auto word = static_cast<std::uint32_t>(sim::unsigned_at(bytes, at, 4, false));
  float value = 0.0f;
  std::memcpy(&value, &word, sizeof value);
  return value;
}

/// Attributes of the first header: name, type, size and value, up to an empty name (the OpenEXR file layout).
void declare_exr(std::string_view bytes, DeclaredLight& light) {
  std::optional<std::array<int, 4>> data, display;
  std::size_t at = 8;
  const auto word = [&]() {
    const std::size_t end = bytes.find('\0', std::min(at, bytes.size()));
    const std::string_view text =
        end == std::string_view::npos ? std::string_view() : bytes.substr(at, end - at);
    at = end == std::string_view::npos ? bytes.size() : end + 1;
    return text;
  };
  while (true) {
    const std::string_view name = word();
    if (name.empty()) break;
    const std::string_view type = word();
    if (at + 4 > bytes.size()) return;
    const std::size_t size = sim::unsigned_at(bytes, at, 4, false);
    at += 4;
    if (size > bytes.size() - at) return;
    if (type == "box2i" && size == 16) {
      std::array<int, 4> box{};
      for (std::size_t i = 0; i < 4; ++i)
        box[i] = static_cast<std::int32_t>(sim::unsigned_at(bytes, at + 4 * i, 4, false));
      if (name == "dataWindow") data = box;
      if (name == "displayWindow") display = box;
    }
    if (name == "chromaticities" && type == "chromaticities" && size == 32) {
      const std::string_view numbers = bytes.substr(at, size);
      const Chromaticities said =
          chromaticities_of([&](std::size_t i) { return double{little_float(numbers, 4 * i)}; }, false);
      light.words.push_back(
          fmt::format("EXR chromaticities red {:g} {:g}, green {:g} {:g}, blue {:g} {:g}, white {:g} {:g}",
                      said.red[0], said.red[1], said.green[0], said.green[1], said.blue[0], said.blue[1],
                      said.white[0], said.white[1]));
      light.source = "its chromaticities";
      declare_primaries(said, light);
    }
    at += size;
  }
  if (data && display && *data != *display)
    light.words.push_back(fmt::format("EXR data window {} {} to {} {} in the frame {} {} to {} {}",
                                      (*data)[0], (*data)[1], (*data)[2], (*data)[3], (*display)[0],
                                      (*display)[1], (*display)[2], (*display)[3]));
}

void declare_fits(std::string_view bytes, DeclaredLight& light) {
  const auto words = sim::fits_image_words(bytes);
  for (const char* key : {"BAYERPAT", "COLORTYP", "XBAYROFF", "YBAYROFF", "ROWORDER", "BITDEPTH", "SATURATE",
                          "DATAMAX", "BUNIT"})
    if (const auto found = words.find(key); found != words.end() && !found->second.empty())
      light.words.push_back(std::string("FITS ") + key + " " + found->second);
  constexpr int kMostBits = 64;
  if (const auto found = words.find("BITDEPTH"); found != words.end())
    light.converter_bits = std::clamp(std::atoi(found->second.c_str()), 0, kMostBits);
}

/// The remark of a film's frame: "# video h264, …; H.273 primaries 1, transfer 1; assumed: both".
void declare_video(std::string_view bytes, DeclaredLight& light) {
  constexpr std::size_t kAt = 3, kLongest = 512;  // behind "P6\n"
  const std::string_view line = bytes.substr(kAt, std::min(bytes.find('\n', kAt), kAt + kLongest) - kAt);
  light.words.emplace_back(line.substr(2));
  const auto number_behind = [&](std::string_view word) {
    const std::size_t at = line.find(word);
    return at == std::string_view::npos ? 0
                                        : std::atoi(std::string(line.substr(at + word.size(), 3)).c_str());
  };
  const int primaries = number_behind("H.273 primaries "), transfer = number_behind(", transfer ");
  if (primaries == 0 && transfer == 0) return;
  light.source = "its video";
  declare_h273(primaries, transfer, light);
}

}  // namespace declared

DeclaredLight declared_light(std::string_view bytes) {
  using namespace declared;
  DeclaredLight light;
  if (sim::starts_with(bytes, "\xff\xd8"sv)) declare_jpeg(bytes, light);
  if (sim::starts_with(bytes, "\x89PNG\r\n\x1a\n"sv)) declare_png(bytes, light);
  if (sim::starts_with(bytes, "v/1\x01"sv)) declare_exr(bytes, light);
  if (sim::starts_with(bytes, "SIMPLE  ="sv)) declare_fits(bytes, light);
  if (sim::starts_with(bytes, "P6\n# video "sv) || sim::starts_with(bytes, "P5\n# video "sv))
    declare_video(bytes, light);
  if (bytes.substr(std::min<std::size_t>(4, bytes.size()), 4) == "ftyp") declare_heif(bytes, light);
  for (const std::string_view start : {"II\x2a\0"sv, "MM\0\x2a"sv, "II\x2b\0"sv, "MM\0\x2b"sv})
    if (sim::starts_with(bytes, start)) declare_tiff(bytes, light);
  return light;
}

std::optional<Chromaticities> primaries_of_h273(int primaries) {
  for (const declared::NamedPrimaries& known : declared::known_primaries())
    if (known.h273 == primaries && primaries != 0) return known.at;
  return std::nullopt;
}

void declare_primaries(const Chromaticities& at, DeclaredLight& light) {
  const auto matrix = matrix_to_srgb(at);
  if (!matrix) {
    light.problem = "its primaries span no triangle";
    return;
  }
  if (is_near_identity(*matrix)) return;
  light.to_srgb = matrix;
  light.primaries = "its own primaries";
  constexpr double kRounding = 2e-3;
  const auto alike = [](const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return std::abs(a[0] - b[0]) < kRounding && std::abs(a[1] - b[1]) < kRounding;
  };
  for (const declared::NamedPrimaries& known : declared::known_primaries())
    if (alike(known.at.red, at.red) && alike(known.at.green, at.green) && alike(known.at.blue, at.blue) &&
        alike(known.at.white, at.white)) {
      light.primaries = known.name;
      return;
    }
}

}  // namespace vegard::fit
