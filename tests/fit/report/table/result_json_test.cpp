#include "fit/report/table/result_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/base/version.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_fit.h"

namespace vegard::fit::result_json_test {
namespace {

using Json = nlohmann::ordered_json;

TEST(ResultJson, HasTheDocumentedKeysInTheirOrder) {
  const Photo photo = tests::small_photo();
  const Json json = Json::parse(result_json(tests::small_fit(photo)));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"verdict",
                                            "verdict_line",
                                            "reasons",
                                            "checks",
                                            "parameters",
                                            "tied",
                                            "solved",
                                            "derived",
                                            "correlation",
                                            "chi2",
                                            "chi2_initial",
                                            "dof",
                                            "compared",
                                            "gradient_cosine",
                                            "statistics",
                                            "rms_over_peak",
                                            "model_error",
                                            "error_inflation",
                                            "correlated_residuals",
                                            "termination",
                                            "evaluations",
                                            "jacobian_evaluations",
                                            "seed",
                                            "version",
                                            "libraries",
                                            "command",
                                            "inputs",
                                            "decoding"}));
  keys.clear();
  for (const auto& [key, value] : json["parameters"][0].items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"path", "meaning", "value", "unit", "sigma", "interval68",
                                            "why_no_sigma", "initial", "min", "max", "at_limit", "moved",
                                            "moved_sigma", "by_bands"}));
}

TEST(ResultJson, HasWhatThePictureAsksOfTheTables) {
  const Photo photo = tests::small_photo();
  FitResult result = tests::small_fit(photo);
  result.tables = {{630.0, 557.7, 0.83, 0.07, 0.3}, {427.8, 557.7, 1.02, 0.01, 0.15}};
  const Json json = Json::parse(result_json(result));
  EXPECT_EQ(json["tables"].size(), 2u);
  EXPECT_EQ(json["tables"]["630.0"],
            Json({{"over_nm", 557.7}, {"factor", 0.83}, {"ln_sigma", 0.07}, {"ln_sigma_of_tables", 0.3}}));
}

TEST(ResultJson, KeepsEveryNumberExactly) {
  const Photo photo = tests::small_photo();
  const FitResult result = tests::small_fit(photo);
  const Json json = Json::parse(result_json(result));
  EXPECT_EQ(json["parameters"][0]["value"].get<double>(), result.parameters[0].value);
  EXPECT_EQ(json["parameters"][1]["value"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(json["parameters"][0]["interval68"][1].get<double>(), 4.46);
  EXPECT_EQ(json["seed"].get<std::uint64_t>(), 9223372036854775807u);
  EXPECT_EQ(json["dof"], 110);
  ASSERT_EQ(json["statistics"].size(), 2u);
  EXPECT_EQ(json["statistics"][1]["name"], "colour");
  EXPECT_EQ(json["statistics"][1]["weight"], 0.5);
  EXPECT_EQ(json["statistics"][1]["residuals"], 20);
  EXPECT_EQ(json["statistics"][1]["chi2"], 23.456);
  EXPECT_EQ(json["verdict"], "doubtful");
  EXPECT_EQ(json["version"], sim::version());
  EXPECT_EQ(json["command"], result.command);
  EXPECT_EQ(json["inputs"][1]["sha256"], std::string(64, 'a'));
  EXPECT_EQ(json["correlation"][0][0], 1.0);
  EXPECT_EQ(json["checks"][1]["name"], "inside the limits");
  EXPECT_EQ(json["checks"][1]["passed"], false);
  EXPECT_EQ(json["compared"]["regions_px"][0][3], 30);
  EXPECT_EQ(json["compared"]["sum_of_weights"].get<double>(), 1e4 / 3.0);
  EXPECT_EQ(json["parameters"][0]["moved_sigma"].get<double>(), 35.1);
}

TEST(ResultJson, SaysNullForWhatIsUnknownOrNotFinite) {
  const Photo photo = tests::small_photo();
  FitResult result = tests::small_fit(photo);
  result.chi2 = std::numeric_limits<double>::infinity();
  result.correlation[0][1] = std::nan("");
  const std::string text = result_json(result);
  const Json json = Json::parse(text);
  EXPECT_TRUE(json["rms_over_peak"].is_null());
  EXPECT_TRUE(json["gradient_cosine"].is_null());
  EXPECT_TRUE(json["parameters"][1]["moved_sigma"].is_null());
  EXPECT_TRUE(json["chi2"].is_null());
  EXPECT_TRUE(json["correlation"][0][1].is_null());
  EXPECT_TRUE(json["parameters"][1]["sigma"].is_null());
  EXPECT_TRUE(json["parameters"][1]["interval68"].is_null());
  EXPECT_TRUE(tests::has_facts(json["parameters"][1]["why_no_sigma"], "do not determine"));
  EXPECT_TRUE(json["parameters"][0]["why_no_sigma"].is_null());
  EXPECT_TRUE(json["parameters"][1]["min"].is_null());
  EXPECT_TRUE(json["solved"][1]["sigma"].is_null());
}

TEST(ResultJson, OfSeveralPhotographsHoldsWhatEachHas) {
  const Photo photo = tests::small_photo();
  FitResult result = tests::small_fit(photo);
  result.photos.push_back(result.photos[0]);
  result.photos[0].name = "south";
  result.photos[1].name = "north";
  result.photos[1].solved = {{"gain", 0.07, 0.002}};
  result.parameters[1].path = "camera.roll_deg of north";
  result.parameters[1].photo = "north";
  const Json json = Json::parse(result_json(result));
  EXPECT_FALSE(json.contains("solved"));
  EXPECT_FALSE(json.contains("decoding"));
  ASSERT_EQ(json["photos"].size(), 2u);
  EXPECT_EQ(json["photos"][0]["name"], "south");
  EXPECT_EQ(json["photos"][0]["solved"].size(), 3u);
  EXPECT_EQ(json["photos"][1]["solved"][0]["value"], 0.07);
  EXPECT_EQ(json["parameters"][1]["path"], "camera.roll_deg");
  EXPECT_EQ(json["parameters"][1]["photo"], "north");
  EXPECT_FALSE(json["parameters"][0].contains("photo"));
}

TEST(ResultJson, HoldsTheJudgesWhereTheyWereAsked) {
  FitResult result = tests::small_fit(tests::small_photo());
  Json json = Json::parse(result_json(result));
  for (const char* key : {"trade_offs", "profile_intervals", "bootstrap", "chain"})
    EXPECT_FALSE(json.contains(key)) << key;
  ProfiledInterval p;
  p.parameter = 1;
  p.upper68 = 0.4;
  p.rise = {0.0, 1.2};
  p.values = {{4.3, 0.3}, {4.4, 0.41}};
  result.profile_intervals = {p};
  result.bootstrap.emplace();
  result.bootstrap->bands = 24;
  result.bootstrap->sigma = {0.1, 0.2};
  result.bootstrap->interval68 = result.bootstrap->interval95 = {{4.2, 4.4}, {0.1, 0.5}};
  result.chain.emplace();
  ChainErrors& c = *result.chain;
  c.median = c.sigma = c.autocorrelation_steps = c.effective = {1.0, 2.0};
  c.interval68 = c.interval95 = {{4.2, 4.4}, {0.1, std::nan("")}};
  c.samples = {1.0, 2.0};
  result.trade_offs = {"a sentence"};
  json = Json::parse(result_json(result));
  EXPECT_EQ(json["trade_offs"][0], "a sentence");
  EXPECT_EQ(json["profile_intervals"][0]["path"], "sheet.main.phase_rad");
  EXPECT_TRUE(json["profile_intervals"][0]["interval68"][0].is_null());
  EXPECT_EQ(json["profile_intervals"][0]["interval68"][1], 0.4);
  EXPECT_EQ(json["profile_intervals"][0]["values"][1][1], 0.41);
  EXPECT_EQ(json["bootstrap"]["parameters"][1]["sigma"], 0.2);
  EXPECT_EQ(json["chain"]["parameters"][1]["effective_samples"], 2.0);
  EXPECT_TRUE(json["chain"]["parameters"][1]["interval95"][1].is_null());
  EXPECT_FALSE(json["chain"].contains("samples"));
}

TEST(ResultJson, SurvivesAFileNameThatIsNoText) {
  const Photo photo = tests::small_photo();
  FitResult result = tests::small_fit(photo);
  result.inputs[1].name = "\xff\xfe.jpg";
  EXPECT_NO_THROW(Json::parse(result_json(result)));
}

}  // namespace
}  // namespace vegard::fit::result_json_test
