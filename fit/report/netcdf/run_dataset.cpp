#include "fit/report/netcdf/run_dataset.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "fit/answer/result_numbers.h"
#include "fit/answer/trust.h"
#include "fit/report/netcdf/record_json.h"
#include "fit/report/netcdf/table_dataset.h"
#include "fit/report/table/result_json.h"
#include "fit/report/table/sequence_files.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

namespace fs = std::filesystem;
using sim::NetcdfDataset;
using sim::NetcdfVariable;

const std::vector<std::string>& verdict_words() {
  static const std::vector<std::string> kWords = [] {
    std::vector<std::string> words;
    for (const Verdict verdict : kVerdicts) words.emplace_back(verdict_name(verdict));
    return words;
  }();
  return kWords;
}

/// A number with its error, each a variable of one number.
NetcdfVariable& add_quantity(NetcdfDataset& dataset, const std::string& name, const std::string& meaning,
                             const std::string& unit, double value, double sigma) {
  NetcdfVariable& made =
      dataset.real(name, meaning.empty() ? name : meaning, sim::udunits_of(unit), {}, {value});
  const NetcdfVariable& error =
      dataset.real(made.name + "_sigma", "standard error of " + name, sim::udunits_of(unit), {}, {sigma});
  if (unit == "white") made.with("comment", "share of the picture's white");
  made.with("ancillary_variables", error.name);
  return made;
}

class RunDataset {
 public:
  explicit RunDataset(const std::string& directory)
      : directory_(directory),
        json_(read_record(directory + "/result.json", "the directory of a run")),
        dataset_("a fit of vegard", "vegard " + record_text(json_, "version")) {}

  NetcdfDataset build() {
    if (record_text(json_, "verdict").empty() || !json_.contains("parameters"))
      throw sim::unreadable(directory_ + "/result.json", "is no result of a run")
          .expected("the directory of a run");
    take_words();
    take_verdict();
    take_parameters();
    for (const RecordOfRun& tied : record_list(json_, "tied"))
      add_quantity(dataset_, record_text(tied, "path"), record_text(tied, "meaning"),
                   record_text(tied, "unit"), record_number(tied, "value"), record_number(tied, "sigma"))
          .with("equals", record_text(tied, "equals"));
    take_solved(json_, "");
    for (const RecordOfRun& photo : record_list(json_, "photos"))
      take_solved(photo, record_text(photo, "name"));
    take_derived();
    take_tables();
    return std::move(dataset_);
  }

 private:
  void take_words() {
    dataset_.attribute("command", record_text(json_, "command"));
    dataset_.attribute("verdict_line", record_text(json_, "verdict_line"));
    std::string inputs;
    for (const RecordOfRun& input : record_list(json_, "inputs"))
      inputs += (inputs.empty() ? "" : "\n") + record_text(input, "role") + ": " +
                record_text(input, "name") + " " + record_text(input, "sha256");
    dataset_.attribute("inputs", inputs);
    if (const std::string decoding = record_text(json_, "decoding"); !decoding.empty())
      dataset_.attribute("decoding", decoding);
  }

  void take_verdict() {
    dataset_.flags("verdict", "verdict on the fit", verdict_words(), {},
                   {sim::flag_number(verdict_words(), record_text(json_, "verdict"))});
    std::vector<std::string> names, words;
    std::vector<int> passed;
    for (const RecordOfRun& check : record_list(json_, "checks")) {
      names.push_back(record_text(check, "name"));
      words.push_back(record_text(check, "words"));
      passed.push_back(check.contains("passed") && check["passed"] == true ? 1 : 0);
    }
    if (!names.empty()) {
      dataset_.dimension("check", names.size());
      dataset_.text("check", "questions behind the verdict", {"check"}, names);
      dataset_.flags("check_passed", "whether the answer supports the fit", {"no", "yes"}, {"check"}, passed);
      dataset_.text("check_words", "the answer", {"check"}, words);
    }
    std::map<std::string, const char*> long_names;  // alphabetical
    for (const ResultNumber& number : result_numbers())
      if (number.long_name != nullptr) long_names[number.key] = number.long_name;
    for (const auto& [key, long_name] : long_names)
      dataset_.real(key, long_name, "1", {}, {record_number(json_, key.c_str())});
  }

  void take_parameters() {
    const RecordOfRun& parameters = record_list(json_, "parameters");
    if (parameters.empty()) return;
    std::vector<std::string> paths, units;
    std::vector<double> interval;
    std::vector<int> at_limit;
    for (const RecordOfRun& p : parameters) {
      const std::string photo = record_text(p, "photo");
      paths.push_back(record_text(p, "path") + (photo.empty() ? "" : " of " + photo));
      units.push_back(sim::udunits_of(record_text(p, "unit")));
      at_limit.push_back(p.contains("at_limit") && p["at_limit"] == true ? 1 : 0);
      const RecordOfRun& ends = record_list(p, "interval68");
      for (std::size_t e = 0; e < 2; ++e)
        interval.push_back(e < ends.size() && ends[e].is_number() ? ends[e].get<double>() : sim::kNaN);
      add_quantity(dataset_, paths.back(), record_text(p, "meaning"), record_text(p, "unit"),
                   record_number(p, "value"), record_number(p, "sigma"))
          .with("path", record_text(p, "path"));
    }
    const std::string own = "each in its parameter_unit";
    const std::vector<std::string> by = {"parameter"};
    const auto numbers = [&](const char* key) {
      std::vector<double> each;
      for (const RecordOfRun& p : parameters) each.push_back(record_number(p, key));
      return each;
    };
    const auto define = [&](const std::string& key, const char* words) -> NetcdfVariable& {
      return dataset_.real("parameter_" + key, words, "", by, numbers(key.c_str())).with("comment", own);
    };
    dataset_.dimension("parameter", parameters.size());
    dataset_.dimension("other_parameter", parameters.size());
    dataset_.dimension("end", 2);
    dataset_.text("parameter", "free parameters", by, paths);
    dataset_.text("other_parameter", "free parameters", {"other_parameter"}, paths);
    dataset_.text("parameter_unit", "unit of each parameter, as UDUNITS has it", by, units);
    define("value", "best values").with("ancillary_variables", "parameter_sigma");
    define("sigma", "standard errors");
    dataset_.real("parameter_interval68", "ends of the 68 % intervals", "", {"parameter", "end"}, interval)
        .with("comment", own);
    define("initial", "where the search began");
    define("min", "lower limits");
    define("max", "upper limits");
    dataset_.flags("parameter_at_limit", "whether a parameter ended at a limit", {"no", "yes"}, by, at_limit);
    take_covariance(numbers("sigma"));
  }

  void take_covariance(const std::vector<double>& sigmas) {
    const std::size_t n = sigmas.size();
    const RecordOfRun& rows = record_list(json_, "correlation");
    std::vector<double> correlation(n * n, sim::kNaN), covariance(n * n, sim::kNaN);
    for (std::size_t i = 0; i < n && i < rows.size(); ++i)
      for (std::size_t j = 0; j < n && rows[i].is_array() && j < rows[i].size(); ++j) {
        // Without an error bar there is no correlation: the file has zeros there.
        if (!rows[i][j].is_number() || !std::isfinite(sigmas[i]) || !std::isfinite(sigmas[j])) continue;
        correlation[i * n + j] = rows[i][j].get<double>();
        covariance[i * n + j] = correlation[i * n + j] * sigmas[i] * sigmas[j];
      }
    dataset_.real("correlation", "correlation of the parameters", "1", {"parameter", "other_parameter"},
                  correlation);
    dataset_
        .real("covariance", "covariance of the parameters", "", {"parameter", "other_parameter"}, covariance)
        .with("comment", "each in the product of its two parameter_unit");
  }

  void take_solved(const RecordOfRun& record, const std::string& photo) {
    for (const RecordOfRun& s : record_list(record, "solved")) {
      const std::string name = record_text(s, "name") + (photo.empty() ? "" : " of " + photo);
      add_quantity(dataset_, name, "solved for: " + name, "", record_number(s, "value"),
                   record_number(s, "sigma"));
    }
  }

  void take_derived() {
    const std::vector<std::string> trusts = {trust_name(Trust::good), trust_name(Trust::doubtful),
                                             trust_name(Trust::unconstrained)};
    for (const RecordOfRun& d : record_list(json_, "derived")) {
      const std::string name = record_text(d, "name"), unit = record_text(d, "unit");
      NetcdfVariable& made =
          add_quantity(dataset_, name, "", unit, record_number(d, "value"), record_number(d, "sigma"));
      std::string beside = made.attribute("ancillary_variables");
      if (const double systematic = record_number(d, "systematic"); std::isfinite(systematic))
        beside += " " + dataset_
                            .real(made.name + "_systematic", "systematic error of " + name,
                                  sim::udunits_of(unit), {}, {systematic})
                            .name;
      NetcdfVariable& trust = dataset_.flags(made.name + "_trust", "whether to trust " + name, trusts, {},
                                             {sim::flag_number(trusts, record_text(d, "trust"))});
      trust.with("reason", record_text(d, "trust_reason"));
      made.with("ancillary_variables", beside + " " + trust.name);
    }
  }

  void take_tables() {
    const auto take = [&](const std::string& file, const std::string& prefix, const std::string& suffix) {
      const std::string path = directory_ + "/" + file;
      std::error_code error;
      if (!fs::exists(path, error)) return;
      add_table(read_text_table(sim::input_bytes(path, "a run's table", kMaxResultBytes), path), prefix,
                suffix, dataset_);
    };
    const RecordOfRun& photos = record_list(json_, "photos");
    if (photos.empty()) take("profiles.csv", "profile_", "");
    for (const RecordOfRun& photo : photos) {
      const std::string name = record_text(photo, "name");
      if (name.find('/') != std::string::npos) continue;
      take("profiles-" + name + ".csv", "profile_", "_" + sim::netcdf_name(name));
    }
    take("profile.csv", "", "");
  }

  std::string directory_;
  RecordOfRun json_;
  NetcdfDataset dataset_;
};

}  // namespace

NetcdfDataset run_dataset(const std::string& directory) { return RunDataset(directory).build(); }

NetcdfDataset sequence_dataset(const std::vector<SequenceRow>& rows) {
  NetcdfDataset dataset("a sequence of fits, each from where the last one ended", "vegard " + sim::version());
  std::vector<std::string> frames, searches = {"warm", "full"};
  std::vector<double> times, chi2;
  std::vector<int> verdicts, searched;
  for (const SequenceRow& row : rows) {
    frames.push_back(row.frame);
    times.push_back(row.time_s);
    chi2.push_back(row.chi2_per_dof);
    verdicts.push_back(sim::flag_number(verdict_words(), verdict_name(row.verdict)));
    searched.push_back(row.searched ? 1 : 0);
  }
  const std::vector<std::string> by = {"time"};
  dataset.dimension("time", rows.size());
  dataset.real("time", "on the scene's clock", "s", by, times);
  dataset.text("frame", "name of the photograph", by, frames);
  dataset.flags("verdict", "verdict on the fit", verdict_words(), by, verdicts);
  dataset.flags("search", "by a descent from the frame before, or by the full search", searches, by,
                searched);
  dataset.real("chi2_per_dof", "chi2 per degree of freedom", "1", by, chi2);
  for (const SequenceNumber& wanted : sequence_numbers(rows)) {
    std::vector<double> values, sigmas;
    for (const SequenceRow& row : rows) {
      const SequenceNumber* const found = find_number(row, wanted.name);
      values.push_back(found == nullptr ? sim::kNaN : found->value);
      sigmas.push_back(found == nullptr ? sim::kNaN : found->sigma.value_or(sim::kNaN));
    }
    const std::string unit = sim::udunits_of(wanted.unit);
    NetcdfVariable& made = dataset.real(wanted.name, wanted.name, unit, by, values);
    made.with("ancillary_variables",
              dataset.real(made.name + "_sigma", "standard error of " + wanted.name, unit, by, sigmas).name);
  }
  return dataset;
}

std::vector<SequenceRow> read_sequence_rows(const std::string& directory) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator entry(directory + "/frames", error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".json") files.push_back(entry->path().string());
  if (files.empty())
    throw sim::unreadable(directory, "has no frame that is done").expected("the directory of a sequence");
  std::sort(files.begin(), files.end());
  std::vector<SequenceRow> rows;
  for (const std::string& file : files)
    rows.push_back(sequence_row_of(sim::input_bytes(file, "a row of a sequence"), file));
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  return rows;
}

NetcdfDataset dataset_of(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error))
    return table_dataset(
        sim::input_bytes(path, "the directory of a run, a map or a sequence, or a table", kMaxResultBytes),
        path);
  if (fs::exists(path + "/result.json", error)) return run_dataset(path);
  if (fs::exists(path + "/map.json", error)) return map_dataset(path);
  if (fs::exists(path + "/sequence.json", error)) return sequence_dataset(read_sequence_rows(path));
  throw sim::unreadable(path, "has no result.json, map.json or sequence.json of vegard's")
      .expected("the directory of a run, a map or a sequence");
}

}  // namespace vegard::fit
