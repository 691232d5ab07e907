#include "fit/report/netcdf/table_dataset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/utc_time.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

/// What a column is; of those with * the rest of the name follows the words.
struct ColumnMeaning {
  const char* name;
  const char* long_name;
  const char* unit;
};
constexpr std::array<ColumnMeaning, 33> kMeanings = {{
    {"band", "strip of columns, counted from 0", "1"},
    {"row_px", "row of the picture, counted from 0 at the top", "1"},
    {"elevation_deg", "elevation above the horizon", "degree"},
    {"azimuth_deg", "azimuth from north to the east", "degree"},
    {"tangent_altitude_km", "least height of the line of sight", "km"},
    {"r", "mean linear light, red", "1"},
    {"g", "mean linear light, green", "1"},
    {"b", "mean linear light, blue", "1"},
    {"sigma_r", "standard error of r", "1"},
    {"sigma_g", "standard error of g", "1"},
    {"sigma_b", "standard error of b", "1"},
    {"n_r", "pixels used, red", "1"},
    {"n_g", "pixels used, green", "1"},
    {"n_b", "pixels used, blue", "1"},
    {"chroma_r", "r / (r + g + b)", "1"},
    {"chroma_g", "g / (r + g + b)", "1"},
    {"sigma_chroma_r", "standard error of chroma_r", "1"},
    {"sigma_chroma_g", "standard error of chroma_g", "1"},
    {"r_over_g", "r / g", "1"},
    {"sigma_r_over_g", "standard error of r_over_g", "1"},
    {"b_over_g", "b / g", "1"},
    {"sigma_b_over_g", "standard error of b_over_g", "1"},
    {"data", "mean linear light of the photograph", "1"},
    {"sigma", "standard deviation that the fit gave the data", "1"},
    {"model", "mean linear light of the best model", "1"},
    {"residual_over_sigma", "(data - model) / sigma", "1"},
    {"count", "pixels used", "1"},
    {"rayleigh_*", "brightness of the line at so many tenths of a nanometre:", "rayleigh"},
    {"sigma_rayleigh_*", "standard error of the brightness of the line", "rayleigh"},
    {"altitude_km", "altitude", "km"},
    {"rate_*", "volume emission rate of the line, per energy flux:", "cm-3 s-1 mW-1 m2"},
    {"lower_*", "lower end of the 68 % interval of the rate of the line", "cm-3 s-1 mW-1 m2"},
    {"upper_*", "upper end of the 68 % interval of the rate of the line", "cm-3 s-1 mW-1 m2"},
}};

struct Meaning {
  std::string long_name, unit;
};

std::optional<Meaning> meaning_of(const std::string& column) {
  for (const ColumnMeaning& known : kMeanings) {
    const std::string name = known.name;
    if (name == column) return Meaning{known.long_name, known.unit};
    if (name.back() != '*' || column.compare(0, name.size() - 1, name, 0, name.size() - 1) != 0) continue;
    return Meaning{std::string(known.long_name) + " " + column.substr(name.size() - 1), known.unit};
  }
  return std::nullopt;
}

bool is_count(const std::string& column) {
  return column == "count" || column == "n_r" || column == "n_g" || column == "n_b";
}

/// The columns that say where a row belongs.
std::vector<std::string> keys_of(const TextTable& table) {
  const std::string& first = table.columns.front();
  const std::string row = table.has("row_px") ? "row_px" : table.has("at") ? "at" : "elevation_deg";
  if (first == "time" && table.has(row)) return {"time", row};
  if (first == "band" && table.has("channel")) return {"band", row, "channel"};
  if (first == "band" && table.has(row)) return {"band", row};
  if (first == "sheet" && table.has("altitude_km")) return {"sheet", "altitude_km"};
  if (first == "azimuth_deg" && table.has("elevation_deg")) return {"azimuth_deg", "elevation_deg"};
  throw sim::unreadable(table.name, "this table is none of those that are known")
      .expected("a table that vegard profile or vegard keogram wrote, or a run's profiles.csv");
}

class TableWriter {
 public:
  TableWriter(const TextTable& table, const std::string& prefix, const std::string& suffix,
              sim::NetcdfDataset& dataset)
      : table_(table),
        keys_(keys_of(table)),
        keyed_(table, keys_),
        prefix_(prefix),
        suffix_(suffix),
        dataset_(dataset) {}

  void write() {
    for (const std::string& key : keys_) {
      dataset_.dimension(dimension(key), keyed_.places(key).size());
      define_key(key);
    }
    for (const std::string& column : table_.columns)
      if (std::find(keys_.begin(), keys_.end(), column) == keys_.end()) define(column);
  }

 private:
  /// Channels are the same in every table.
  std::string dimension(const std::string& key) const { return key == "channel" ? key : key + suffix_; }

  std::vector<std::string> dimensions(const std::vector<std::string>& keys) const {
    std::vector<std::string> names;
    for (const std::string& key : keys) names.push_back(dimension(key));
    return names;
  }

  void define_key(const std::string& key) {
    if (key == "channel") {
      if (dataset_.find(key) == nullptr) dataset_.text(key, "red, green or blue", {key}, keyed_.places(key));
    } else if (key == "sheet") {
      dataset_.text(dimension(key), "sheet", {dimension(key)}, keyed_.places(key));
    } else if (key == "time") {
      define_time();
    } else if (key == "at") {
      dataset_.real(dimension(key), table_.comment("at"), "", {dimension(key)}, keyed_.place_numbers(key));
    } else {
      define_with_words(key, dimension(key), {key});
    }
  }

  void define_time() {
    const std::string words = table_.comment("time");
    const std::vector<std::string>& places = keyed_.places("time");
    if (words.compare(0, 3, "ISO") != 0) {
      dataset_.real("time", "time", words == "seconds" ? "s" : "1", {"time"}, keyed_.place_numbers("time"));
      return;
    }
    std::vector<double> seconds;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const std::optional<double> read = sim::utc_seconds(places[i]);
      if (!read)
        throw sim::unreadable(table_.name, "'" + places[i] + "' is no time")
            .expected("ISO 8601, as a comment of the table says");
      seconds.push_back(*read);
    }
    dataset_
        .real("time", "when the picture was taken", "seconds since 1970-01-01 00:00:00", {"time"}, seconds)
        .with("standard_name", "time")
        .with("calendar", "standard");
  }

  /// A keogram's angle goes on over the zenith.
  std::string long_name_of(const std::string& column, const Meaning& meaning) const {
    return keys_.front() == "time" && column == "elevation_deg"
               ? "elevation from the horizon at azimuth_deg over the zenith to the other one"
               : meaning.long_name;
  }

  sim::NetcdfVariable& define_with_words(const std::string& column, const std::string& name,
                                         const std::vector<std::string>& by) {
    const Meaning meaning = meaning_of(column).value_or(Meaning{column, ""});
    return dataset_.real(name, long_name_of(column, meaning), meaning.unit, dimensions(by),
                         keyed_.numbers(column, by));
  }

  void define(const std::string& column) {
    const std::string name = prefix_ + column + suffix_;
    if (column == "band_at") {
      dataset_.real(name, table_.comment("band_at"), "", dimensions({"band"}),
                    keyed_.numbers(column, {"band"}));
      return;
    }
    // The elevation of a row is that of all channels.
    const bool is_place = column == "elevation_deg" || column == "tangent_altitude_km";
    std::vector<std::string> by = keys_;
    if (is_place && by.back() == "channel") by.pop_back();
    if (is_count(column)) {
      const Meaning meaning = *meaning_of(column);
      const std::vector<double> numbers = keyed_.numbers(column, by);
      std::vector<int> counts;
      for (const double count : numbers)
        if (std::isfinite(count)) counts.push_back(static_cast<int>(std::clamp(count, 0.0, 2e9)));
      // Whole numbers have no value for what is unknown.
      if (counts.size() < numbers.size()) {
        dataset_.real(name, meaning.long_name, meaning.unit, dimensions(by), numbers);
        return;
      }
      dataset_.whole(name, meaning.long_name, meaning.unit, dimensions(by), counts);
      return;
    }
    sim::NetcdfVariable& made = define_with_words(column, name, by);
    if (is_place) return;
    std::string beside;
    for (const std::string& other : {"sigma_" + column, column == "data" ? std::string("sigma") : "",
                                     "n_" + column, column == "data" ? std::string("count") : ""})
      if (!other.empty() && table_.has(other))
        beside += (beside.empty() ? "" : " ") + sim::netcdf_name(prefix_ + other + suffix_);
    if (!beside.empty()) made.with("ancillary_variables", beside);
    std::string places;
    for (const char* place : {"elevation_deg", "tangent_altitude_km"})
      if (table_.has(place) && std::find(keys_.begin(), keys_.end(), place) == keys_.end())
        places += (places.empty() ? "" : " ") + sim::netcdf_name(prefix_ + place + suffix_);
    if (!places.empty()) made.with("coordinates", places);
  }

  const TextTable& table_;
  std::vector<std::string> keys_;
  KeyedTable keyed_;
  std::string prefix_, suffix_;
  sim::NetcdfDataset& dataset_;
};

}  // namespace

void add_table(const TextTable& table, const std::string& prefix, const std::string& suffix,
               sim::NetcdfDataset& dataset) {
  TableWriter(table, prefix, suffix, dataset).write();
}

sim::NetcdfDataset table_dataset(std::string_view text, const std::string& name) {
  const TextTable table = read_text_table(text, name);
  sim::NetcdfDataset dataset(table.title, "vegard " + sim::version());
  // Several pictures of a keogram are one attribute of as many lines.
  std::vector<std::string> keys;
  std::map<std::string, std::string> words;
  for (const auto& [key, text_of] : table.comments) {
    if (table.has(key)) continue;
    const std::string attribute = sim::netcdf_name(key);
    const auto [found, is_new] = words.emplace(attribute, text_of);
    if (is_new)
      keys.push_back(attribute);
    else
      found->second += "\n" + text_of;
  }
  for (const std::string& key : keys)
    if (key != "title" && key != "source" && key != "Conventions") dataset.attribute(key, words[key]);
  add_table(table, "", "", dataset);
  return dataset;
}

}  // namespace vegard::fit
