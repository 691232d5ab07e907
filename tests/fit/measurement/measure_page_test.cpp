#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fit/measurement/measure.h"
#include "fit/measurement/measure_answer.h"
#include "fit/measurement/traces_picture.h"
#include "tests/support/made_measurement.h"

namespace vegard::fit::measure_page_test {
namespace {

using made_measurement::measured;
using made_measurement::trace;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// Claimed traces one above the other, and two that are not.
Measurement with_traces(int claimed) {
  std::vector<BorderTrace> traces;
  for (int i = 0; i < claimed; ++i) traces.push_back(trace(130, 230, 20 + 5 * i, 0.99));
  traces.push_back(trace(20, 60, 30, 0.4));
  traces.push_back(trace(20, 60, 40, 0.4));
  Measurement m = measured(traces);
  m.photo = "sky.png";
  m.pictures = {"traces.svg"};
  const MeasureAnswer answer = measure_answer(m);
  m.word = answer.word;
  m.trust = answer.trust;
  m.answer = answer.sentences;
  m.not_known = answer.not_known;
  return m;
}

Photo dark_photo(const sim::Camera& camera) {
  Photo photo;
  photo.linear = sim::Image(camera.width, camera.height, {"R", "G", "B"});
  return photo;
}

TEST(MeasurePage, NamesSixTracesAndCountsTheRest) {
  const std::string page = measure_page(with_traces(8));
  EXPECT_EQ(count(page, "</i>border "), kNamedTraces);
  EXPECT_EQ(count(page, "and 2 more"), 1u);
  EXPECT_EQ(count(page, "aurora (2)"), 1u);
  EXPECT_EQ(count(page, "<tr><td>"), 8u);  // all claimed ones in the table, and no others
  EXPECT_EQ(count(page, "verdict good"), 1u);
}

TEST(MeasurePage, WithoutAClaimHasNoTableAndNoGreenBanner) {
  const std::string page = measure_page(with_traces(0));
  EXPECT_EQ(count(page, "<tr><td>"), 0u);
  EXPECT_EQ(count(page, "verdict good"), 0u);
  EXPECT_EQ(count(page, "2 edges (stars)"), 1u);
}

TEST(TracesPicture, DrawsClaimedTracesInColoursOfTheirOwnAndOthersGrey) {
  const Measurement m = with_traces(8);
  const std::string svg = traces_svg(*m.border, dark_photo(m.border_scene->camera), *m.border_scene);
  for (std::size_t t = 0; t < kNamedTraces; ++t) {
    EXPECT_EQ(count(svg, "stroke=\"" + trace_colour(t) + "\""), 1u) << t;
    for (std::size_t u = 0; u < t; ++u) EXPECT_NE(trace_colour(t), trace_colour(u));
  }
  EXPECT_EQ(count(svg, "stroke=\"" + trace_colour(kNamedTraces) + "\""), 2u);
  EXPECT_EQ(count(svg, "stroke=\"" + unclaimed_colour() + "\""), 2u);
}

TEST(TracesPicture, IsAsWideAsAPageForAnyPicture) {
  const Measurement m = with_traces(1);
  EXPECT_EQ(count(traces_svg(*m.border, dark_photo(m.border_scene->camera), *m.border_scene),
                  "width=\"1060\" height=\"1060\""),
            2u);  // of the document and of the photograph in it
}

}  // namespace
}  // namespace vegard::fit::measure_page_test
