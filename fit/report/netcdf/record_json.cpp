#include "fit/report/netcdf/record_json.h"

#include "fit/report/table/result_json.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {

RecordOfRun read_record(const std::string& file, const std::string& expected) {
  RecordOfRun json = RecordOfRun::parse(sim::input_bytes(file, expected, kMaxResultBytes), nullptr, false);
  if (!json.is_object()) throw sim::unreadable(file, "is no JSON").expected(expected);
  return json;
}

double record_number(const RecordOfRun& json, const char* key) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  return found != json.end() && found->is_number() ? found->get<double>() : sim::kNaN;
}

std::string record_text(const RecordOfRun& json, const char* key) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

const RecordOfRun& record_list(const RecordOfRun& json, const char* key) {
  static const RecordOfRun kNone = RecordOfRun::array();
  const auto found = json.is_object() ? json.find(key) : json.end();
  return found != json.end() && found->is_array() ? *found : kNone;
}

}  // namespace vegard::fit
