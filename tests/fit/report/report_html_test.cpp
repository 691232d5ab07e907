#include "fit/report/report_html.h"

#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string>
#include <vector>

#include "sim/base/shown_text.h"
#include "tests/support/small_fit.h"

namespace vegard::fit::report_html_test {
namespace {

/// Every tag is closed by its own kind, in order. Returns what is wrong, or nothing.
std::string unbalanced_tag(const std::string& html) {
  static const std::set<std::string> kVoid = {"meta", "img", "br", "!DOCTYPE"};
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    const std::size_t end = html.find('>', at);
    if (end == std::string::npos) return "a tag without an end";
    const bool closes = html[at + 1] == '/';
    std::size_t last = at + (closes ? 2 : 1);
    while (std::isalnum(static_cast<unsigned char>(html[last])) || html[last] == '!') ++last;
    const std::string name = html.substr(at + (closes ? 2 : 1), last - at - (closes ? 2 : 1));
    if (name.empty()) return "a bare '<' near: " + html.substr(at, 40);
    if (closes) {
      if (open.empty() || open.back() != name) return "</" + name + "> closes nothing";
      open.pop_back();
    } else if (html[end - 1] != '/' && kVoid.count(name) == 0) {
      open.push_back(name);
    }
    at = end;
  }
  return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

struct Page {
  explicit Page(FitResult result, const Photo& photo = tests::small_photo())
      : html(page(result, photo, model_picture(result.photos[0], photo, 1))) {}
  static std::string page(const FitResult& result, const Photo& photo, const ModelPicture& model) {
    return report_html(
        result, {{&result.photos[0], &photo, &model, [](double, double y_px) { return 60.0 - y_px; }}});
  }
  bool has(const std::string& text) const { return html.find(text) != std::string::npos; }
  std::string html;
};

FitResult small_result() { return tests::small_fit(tests::small_photo()); }

// As of the Sun in one line.
TEST(ReportHtml, ShowsGreyLightAsOneChannel) {
  EXPECT_TRUE(Page(small_result()).has("<span>red</span>"));
  FitResult result = small_result();
  FittedPhoto& photo = result.photos[0];
  photo.best.sensor.response = "grey";
  for (std::size_t i = 0; i < photo.sigma.size(); ++i)
    if (i % 3 != 1) photo.sigma[i] = 0.0;
  const Page page(result);
  EXPECT_EQ(unbalanced_tag(page.html), "");
  for (const char* colour : {"<span>red</span>", ">red<", ">green<", ">blue<", "r / (r + g + b)"})
    EXPECT_FALSE(page.has(colour)) << colour;
}

TEST(ReportHtml, SaysWhetherProfilesWereCompared) {
  const char* const kFitted = "This is what was fitted";
  EXPECT_TRUE(Page(small_result()).has(kFitted));
  FitResult result = small_result();
  result.photos[0].best.fit.weight[sim::StatisticKind::profile] = 0.0;
  const Page page(result);
  EXPECT_FALSE(page.has(kFitted));
  EXPECT_TRUE(page.has("not compared"));
}

// A Sun has no sheets, no feet and no line of 557.7 nm.
TEST(ReportHtml, SpeaksOfTheSunInItsOwnWords) {
  const char* const kOfSheets[] = {"spacing of its beams", "one kilorayleigh of 557.7", "map.svg"};
  const Page aurora(small_result());
  for (const char* words : kOfSheets) EXPECT_TRUE(aurora.has(words)) << words;
  FitResult result = small_result();
  for (sim::Scene* scene : {&result.best, &result.photos[0].best}) {
    scene->sheets.clear();
    scene->sun.shown = true;
  }
  result.foot_bands.clear();
  const Page sun(result);
  for (const char* words : kOfSheets) EXPECT_FALSE(sun.has(words)) << words;
}

TEST(ReportHtml, IsBalancedAndNeedsNothingElse) {
  const Page page(small_result());
  EXPECT_EQ(unbalanced_tag(page.html), "");
  EXPECT_FALSE(page.has("<script"));
  EXPECT_FALSE(page.has("<link"));
  EXPECT_FALSE(page.has("url("));
  EXPECT_FALSE(page.has("@import"));
  // Addresses only as the name of the SVG language.
  std::string rest = page.html;
  const std::string svg = "xmlns=\"http://www.w3.org/2000/svg\"";
  for (std::size_t at = rest.find(svg); at != std::string::npos; at = rest.find(svg))
    rest.erase(at, svg.size());
  EXPECT_EQ(rest.find("http"), std::string::npos);
}

TEST(ReportHtml, ShowsPicturesPlotsAndNumbers) {
  const Page page(small_result());
  std::size_t pictures = 0, plots = 0;
  for (std::size_t at = page.html.find("data:image/png;base64,iVBORw0KGgo"); at != std::string::npos;
       at = page.html.find("data:image/png;base64,iVBORw0KGgo", at + 1))
    ++pictures;
  for (std::size_t at = page.html.find("role=\"img\""); at != std::string::npos;
       at = page.html.find("role=\"img\"", at + 1))
    ++plots;
  EXPECT_EQ(pictures, 4u);
  EXPECT_EQ(plots, 6u);
  EXPECT_TRUE(page.has("class=\"verdict doubtful\""));
  EXPECT_TRUE(page.has("4.33 \u00b1 0.12"));
  EXPECT_TRUE(page.has("220.1 \u00b1 3.2"));
  EXPECT_TRUE(page.has("no error bar"));
  EXPECT_TRUE(page.has("at a limit</div>"));
  EXPECT_TRUE(page.has("9223372036854775807"));
  EXPECT_TRUE(page.has(std::string(64, 'b')));
}

TEST(ReportHtml, EscapesWhatComesFromTheUser) {
  const Page page(small_result());
  EXPECT_FALSE(page.has("a <b>"));
  EXPECT_TRUE(page.has("a &lt;b&gt; &amp; &quot;c&quot;.jpg"));
  EXPECT_TRUE(page.has("something &lt;else&gt;"));
  EXPECT_EQ(sim::html_text("<&>\"'\x01\xff"), "&lt;&amp;&gt;&quot;&#39; \ufffd");
}

TEST(ReportHtml, TellsAReasonOnce) {
  const Page page(small_result());
  EXPECT_FALSE(page.has("<li>sheet.main.energy_kev is at a limit</li>"));
}

TEST(ReportHtml, ListsTheVerdictsChecks) {
  const Page page(small_result());
  EXPECT_TRUE(page.has("<li class=\"passed\"><b>\u2713 converged</b> "));
  EXPECT_TRUE(page.has("<li class=\"missed\"><b>\u2717 inside the limits</b> not passed</li>"));
}

TEST(ReportHtml, StandsWithoutAnAnswer) {
  FitResult result = small_result();
  result.verdict = Verdict::failed;
  result.parameters.clear();
  result.correlation.clear();
  result.photos[0].model.clear();
  result.photos[0].gain.clear();
  result.trace.clear();
  result.photos[0].solved.clear();
  result.derived.clear();
  result.dof = 0;
  const Page page(result);
  EXPECT_EQ(unbalanced_tag(page.html), "");
  EXPECT_FALSE(page.has(">nan"));
  EXPECT_FALSE(page.has(">inf"));
}

/// Both parameters have error bars, by all validations: the bootstrap's of the energy is three times as wide.
FitResult validated_result() {
  FitResult result = small_result();
  result.parameters[1].sigma = 0.02;
  result.parameters[1].interval68 = {0.31, 0.35};
  result.correlation = {{1.0, -0.95}, {-0.95, 1.0}};
  result.trade_offs = {"energy & phase are correlated"};
  ProfiledInterval p;
  p.parameter = 1;
  p.lower68 = 0.312;
  p.lower95 = 0.29;
  result.profile_intervals = {p};
  BootstrapErrors b;
  b.bands = 24;
  b.replicates = 1000;
  b.sigma = {0.37, 0.02};
  b.interval68 = b.interval95 = {{3.96, 4.71}, {0.31, 0.35}};
  result.bootstrap = b;
  ChainErrors c;
  c.walkers = 8;
  c.steps = 500;
  c.acceptance = 0.31;
  c.median = {4.33, 0.33};
  c.sigma = {0.13, 0.02};
  c.interval68 = c.interval95 = {{4.2, 4.47}, {0.31, 0.35}};
  c.effective = {400.0, 123.0};
  c.autocorrelation_steps = {10.0, 32.5};
  c.samples = {4.3, 0.33, 4.4, 0.32, 4.2, 0.35};
  result.chain = c;
  return result;
}

TEST(ReportHtml, ShowsTheValidationOfTheErrorBars) {
  const Page page(validated_result());
  EXPECT_EQ(unbalanced_tag(page.html), "");
  EXPECT_TRUE(page.has("<h2>Validation of the error bars</h2>"));
  EXPECT_TRUE(page.has("3.96 to 4.71 <span class=\"flag\">\u00d7&#160;3</span>"));
  EXPECT_TRUE(page.has("above 0.312"));
  EXPECT_TRUE(page.has("1000 draws of 24 bands"));
  EXPECT_TRUE(page.has("is 123"));
  EXPECT_TRUE(page.has("too short"));
  EXPECT_TRUE(page.has("energy &amp; phase"));
  EXPECT_TRUE(page.has("Every parameter"));
  EXPECT_FALSE(Page(small_result()).has("Validation"));
}

TEST(ReportHtml, IsTheSameEveryTime) { EXPECT_EQ(Page(small_result()).html, Page(small_result()).html); }

// RFC 4648, section 10.
TEST(Base64, HasTheTestVectorsOfItsStandard) {
  EXPECT_EQ(sim::base64(""), "");
  EXPECT_EQ(sim::base64("f"), "Zg==");
  EXPECT_EQ(sim::base64("fo"), "Zm8=");
  EXPECT_EQ(sim::base64("foo"), "Zm9v");
  EXPECT_EQ(sim::base64("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace vegard::fit::report_html_test
