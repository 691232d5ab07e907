#include "apps/options/json_answer.h"

#include <cmath>

#include "apps/options/standard_streams.h"

namespace vegard::apps {

Json& json_answer() {
  static Json answer = Json::object();
  return answer;
}

void answer_with(const std::string& json) {
  if (voice().is_json) json_answer() = Json::parse(json);
}

Json json_number(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? Json(*number) : Json(nullptr);
}

Json json_names(const std::vector<std::string>& names) {
  Json list = Json::array();
  for (const std::string& name : names)
    if (!name.empty()) list.push_back(name);
  return list;
}

std::string json_answer_text() {
  // A file's name may hold bytes that are no UTF-8.
  return json_answer().dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace vegard::apps
