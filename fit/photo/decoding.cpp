#include "fit/photo/decoding.h"

#include <filesystem>

#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/table/table_files.h"

namespace vegard::fit {
namespace {

using Kind = sim::DecodingWord::Kind;

constexpr std::size_t kDigitsOfHash = 12;  // tell curves of one name apart

std::string text_of_file(const std::string& file) {
  return sim::input_bytes(file, "a CSV file with the columns linear and encoded");
}

Decoding of_curve(const sim::ToneCurve& curve, const std::string& words) {
  return {Decoding::Kind::curve, std::make_shared<const sim::ToneCurve>(curve), words, 0};
}

}  // namespace

Decoding decoding_of_word(const std::string& text, const sim::Scene* scene, const std::string& beside) {
  if (const auto complaint = sim::decoding_complaint(text))
    throw sim::Error(sim::ErrorKind::usage, complaint->problem)
        .key("--decoding")
        .expected(complaint->expected)
        .hint(complaint->hint);
  const sim::DecodingWord word = sim::decoding_word(text);
  switch (word.kind) {
    case Kind::automatic:
      return Decoding::automatic;
    case Kind::srgb:
      return Decoding::srgb;
    case Kind::linear:
      return Decoding::linear;
    case Kind::sensor:
      return Decoding::sensor;
    case Kind::unknown:
      return {Decoding::Kind::unknown, {}, {}, word.unknowns};
    case Kind::gamma: {
      const sim::ToneCurve curve = sim::ToneCurve::of_gamma(word.gamma);
      return of_curve(curve, curve.name());
    }
    case Kind::bent: {
      const sim::ToneCurve curve = sim::ToneCurve::of_bent({word.black, word.white});
      return of_curve(curve, curve.name());
    }
    case Kind::curve:
      break;
  }
  const bool is_in_scene =
      scene != nullptr && scene->fit.decoding == text && scene->tables.count("fit.decoding") > 0;
  const std::string file = is_in_scene ? sim::table_place(*scene, word.file)
                                       : (std::filesystem::path(beside) / word.file).string();
  const std::string table = is_in_scene ? sim::table_text(*scene, "fit.decoding") : text_of_file(file);
  const sim::ToneCurve curve = sim::ToneCurve::of_table(table, file);
  return of_curve(curve,
                  "curve " + curve.name() + ", SHA-256 " + sim::sha256(table).substr(0, kDigitsOfHash));
}

}  // namespace vegard::fit
