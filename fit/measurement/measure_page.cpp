#include "fit/measurement/measure.h"

#include <nlohmann/json.hpp>

#include "fit/report/report_style.h"
#include "sim/base/shown_text.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

using sim::html_text;

std::string stage_section(const MeasureStage& stage) {
  std::string html = "<section>\n<h2>" + html_text(stage.title) + " <small>(" + trust_name(stage.trust) +
                     ")</small></h2>\n<p>" + html_text(stage.found) + "</p>\n";
  if (!stage.lacking.empty()) html += "<p><b>What would help:</b> " + html_text(stage.lacking) + "</p>\n";
  if (!stage.files.empty()) {
    html += "<p>Written:";
    for (const std::string& file : stage.files)
      html += " <a href=\"" + html_text(file) + "\">" + html_text(file) + "</a>";
    html += "</p>\n";
  }
  if (!stage.command.empty())
    html += "<details><summary>The same by hand</summary>\n<pre><code>" + html_text(stage.command) +
            "</code></pre>\n<pre>" + html_text(stage.words) + "</pre></details>\n";
  return html + "</section>\n";
}

}  // namespace

std::string measure_page(const Measurement& m) {
  std::string html = headed_page("What " + m.photo + " tells");
  html += std::string("<div class=\"verdict ") +
          (m.trust == Trust::unconstrained ? "failed" : trust_name(m.trust)) +
          "\"><div><div class=\"word\">" + trust_name(m.trust) + "</div><div>";
  for (const std::string& sentence : m.answer)
    html += "<div class=\"line\">" + html_text(sentence) + "</div>";
  html += "</div></div></div>\n<main>\n";
  for (const std::string& picture : m.pictures)
    html += "<figure><img style=\"max-width:100%\" src=\"" + html_text(picture) + "\" alt=\"" +
            html_text(picture) + "\"></figure>\n";
  for (const MeasureStage& stage : m.stages) html += stage_section(stage);
  html += "<section>\n<h2>Command</h2>\n<pre><code>" + html_text(m.command) + "</code></pre>\n</section>\n";
  return html + "</main>\n</body>\n</html>\n";
}

std::string measure_json(const Measurement& m) {
  nlohmann::ordered_json json;
  json["kind"] = "vegard measure";
  json["version"] = sim::version();
  json["command"] = m.command;
  json["photo"] = m.photo;
  json["trust"] = trust_name(m.trust);
  json["answer"] = m.answer;
  json["stages"] = nlohmann::ordered_json::array();
  for (const MeasureStage& s : m.stages)
    json["stages"].push_back({{"title", s.title},
                              {"trust", trust_name(s.trust)},
                              {"found", s.found},
                              {"lacking", s.lacking},
                              {"command", s.command},
                              {"exit_code", s.exit_code},
                              {"files", s.files},
                              {"numbers", s.numbers.empty() ? nlohmann::ordered_json(nullptr)
                                                            : nlohmann::ordered_json::parse(s.numbers)}});
  // A file's name may hold bytes that are no UTF-8.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace vegard::fit
