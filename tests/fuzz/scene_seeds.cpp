// Scenes to begin with: the examples, the gallery and the tests' own.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "sim/scene/file/scene_toml.h"
#include "sim/scene/freedom/expression.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/fuzz/target.h"

namespace vegard::tests {

std::vector<std::string> fuzz_seeds(const std::string& source) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for (const char* folder : {"/data/examples", "/data/gallery", "/tests/cli/scenes"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source + folder))
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  sim::Scene whole;
  whole.sheets.emplace_back();
  seeds.push_back(sim::write_scene(whole));
  seeds.push_back(
      "[[sheet]]\nname = \"a\"\n[[sheet]]\nname = \"b-1\"\n[fit]\n"
      "free = [\"sheet.a.energy_kev\", { path = \"sheet.a.center_km.north\", min = 1.0, max = 900.0, "
      "prior = { mean = 100.0, sigma = 10.0 } }]\n"
      "tied = [{ path = \"sheet.b-1.energy_kev\", equals = \"0.8 * sheet.a.energy_kev ^ (1 + "
      "sin_deg(17))\" }]\n"
      "#set camera.width=64\n#set sheet.a.center_km=[1.0, 2.0]\n#set emission.lines=[557.7, 630.0]\n");
  return seeds;
}

std::vector<std::string> fuzz_dictionary() {
  std::vector<std::string> words = {"[[sheet]]\n", "\"\"\"",    "'''",
                                    "\n[fit]\n",   "free = [",  "tied = [{ path = ",
                                    "equals = \"", "photo = [", "{ ",
                                    " }",          "nan",       "inf",
                                    "-inf",        "1e400",     "1979-05-27T07:32:00Z",
                                    "true",        "\\u0000",   "\\U0010ffff",
                                    "\n#set ",     "[[[[[[[["};
  for (const sim::ParameterRow& row : sim::parameter_table()) {
    words.push_back(row.key + " = ");
    if (!row.table.empty()) words.push_back("\n[" + row.table + "]\n");
    words.push_back("\n#set " + sim::path_pattern(row) + "=");
    for (const std::string& choice : row.choices) words.push_back("\"" + choice + "\"");
  }
  for (const std::string& word : sim::Expression::reserved_words()) words.push_back(word + "(");
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

void mend_after_mutation(std::string&) {}

}  // namespace vegard::tests
