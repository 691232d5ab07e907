#include "sim/base/file/netcdf_dataset.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>

#include "sim/base/file/whole_file.h"
#include "sim/base/text.h"

namespace vegard::sim {

std::string NetcdfNames::of(const std::string& words) {
  const std::string name = netcdf_name(words);
  std::string found = name;
  for (int i = 2; !taken_.insert(found).second; ++i) found = name + "_" + std::to_string(i);
  return found;
}

std::string netcdf_flag_meanings(const std::vector<std::string>& words) {
  std::string meanings;
  for (std::string word : words) {
    std::replace(word.begin(), word.end(), ' ', '_');
    meanings += (meanings.empty() ? "" : " ") + word;
  }
  return meanings;
}

int flag_number(const std::vector<std::string>& words, const std::string& word) {
  const auto found = std::find(words.begin(), words.end(), word);
  return found == words.end() ? kNetcdfNoFlag : static_cast<int>(found - words.begin());
}

std::string udunits_of(const std::string& unit) {
  // Of a velocity's unit the part before "/s".
  const std::string per_second = "/s";
  if (unit != "m/s" && unit.size() > per_second.size() && ends_with(unit, per_second))
    return udunits_of(unit.substr(0, unit.size() - per_second.size())) + " s-1";
  if (unit.empty() || unit == "white" || unit == "dex" || unit == "px") return "1";
  if (unit == "deg" || unit == "\u00b0") return "degree";
  static const std::array<std::pair<const char*, const char*>, 11> kRaised = {{{"\u207b", "-"},
                                                                               {"\u2070", "0"},
                                                                               {"\u00b9", "1"},
                                                                               {"\u00b2", "2"},
                                                                               {"\u00b3", "3"},
                                                                               {"\u2074", "4"},
                                                                               {"\u2075", "5"},
                                                                               {"\u2076", "6"},
                                                                               {"\u2077", "7"},
                                                                               {"\u2078", "8"},
                                                                               {"\u2079", "9"}}};
  std::string plain = unit;
  for (const auto& [raised, digit] : kRaised)
    for (std::size_t at = plain.find(raised); at != std::string::npos; at = plain.find(raised))
      plain.replace(at, std::string(raised).size(), digit);
  return plain;
}

NetcdfVariable& NetcdfVariable::with(const std::string& attribute, const std::string& words) {
  for (auto& [key, old] : attributes)
    if (key == attribute) {
      old = words;
      return *this;
    }
  attributes.emplace_back(attribute, words);
  return *this;
}

std::string NetcdfVariable::attribute(const std::string& wanted) const {
  for (const auto& [key, words] : attributes)
    if (key == wanted) return words;
  return {};
}

NetcdfDataset::NetcdfDataset(const std::string& title, const std::string& source) {
  attribute("Conventions", "CF-1.8");
  attribute("title", title);
  attribute("source", source);
}

void NetcdfDataset::attribute(const std::string& name, const std::string& words) {
  attributes_.emplace_back(name, words);
}

void NetcdfDataset::dimension(const std::string& name, std::size_t size) {
  for (const auto& [known, known_size] : dimensions_)
    if (known == name) {
      assert(known_size == size);
      return;
    }
  dimensions_.emplace_back(name, size);
}

std::size_t NetcdfDataset::size_of(const std::string& dimension) const {
  for (const auto& [name, size] : dimensions_)
    if (name == dimension) return size;
  return 0;
}

std::size_t NetcdfDataset::count_of(const std::vector<std::string>& dimensions) const {
  std::size_t count = 1;
  for (const std::string& name : dimensions) count *= size_of(name);
  return count;
}

const NetcdfVariable* NetcdfDataset::find(const std::string& name) const {
  for (const NetcdfVariable& variable : variables_)
    if (variable.name == name) return &variable;
  return nullptr;
}

NetcdfVariable& NetcdfDataset::add(const std::string& name, NetcdfType type, const std::string& long_name,
                                   const std::string& unit, const std::vector<std::string>& dimensions) {
  NetcdfVariable variable;
  variable.name = names_.of(name);
  variable.type = type;
  variable.dimensions = dimensions;
  variable.with("long_name", long_name);
  if (!unit.empty()) variable.with("units", unit);
  variables_.push_back(std::move(variable));
  return variables_.back();
}

NetcdfVariable& NetcdfDataset::real(const std::string& name, const std::string& long_name,
                                    const std::string& unit, const std::vector<std::string>& dimensions,
                                    std::vector<double> values) {
  assert(values.size() == count_of(dimensions));
  NetcdfVariable& made = add(name, NetcdfType::real, long_name, unit, dimensions);
  made.reals = std::move(values);
  return made;
}

NetcdfVariable& NetcdfDataset::whole(const std::string& name, const std::string& long_name,
                                     const std::string& unit, const std::vector<std::string>& dimensions,
                                     std::vector<int> values) {
  assert(values.size() == count_of(dimensions));
  NetcdfVariable& made = add(name, NetcdfType::whole, long_name, unit, dimensions);
  made.numbers = std::move(values);
  return made;
}

NetcdfVariable& NetcdfDataset::flags(const std::string& name, const std::string& long_name,
                                     const std::vector<std::string>& words,
                                     const std::vector<std::string>& dimensions, std::vector<int> values) {
  assert(values.size() == count_of(dimensions));
  NetcdfVariable& made = add(name, NetcdfType::flag, long_name, "", dimensions);
  made.flag_words = words;
  made.numbers = std::move(values);
  return made;
}

NetcdfVariable& NetcdfDataset::text(const std::string& name, const std::string& long_name,
                                    const std::vector<std::string>& dimensions,
                                    std::vector<std::string> values) {
  assert(values.size() == count_of(dimensions));
  NetcdfVariable& made = add(name, NetcdfType::text, long_name, "", dimensions);
  made.texts = std::move(values);
  return made;
}

void NetcdfDataset::write(const std::string& name, const std::string& shown_name) const {
  NetcdfFile file(name, shown_name);
  std::map<std::string, NetcdfFile::Dimension> by_name;
  for (const auto& [dimension, size] : dimensions_) by_name[dimension] = file.dimension(dimension, size);
  std::vector<NetcdfFile::Variable> made;
  for (const NetcdfVariable& variable : variables_) {
    std::vector<NetcdfFile::Dimension> dimensions;
    for (const std::string& dimension : variable.dimensions) dimensions.push_back(by_name.at(dimension));
    made.push_back(file.variable(variable.name, variable.type, dimensions));
    for (const auto& [key, words] : variable.attributes) file.attribute(made.back(), key, words);
    if (variable.flag_words.empty()) continue;
    std::vector<int> values;
    for (std::size_t i = 0; i < variable.flag_words.size(); ++i) values.push_back(static_cast<int>(i));
    file.flags(made.back(), "flag_values", values);
    file.attribute(made.back(), "flag_meanings", netcdf_flag_meanings(variable.flag_words));
  }
  for (const auto& [key, words] : attributes_) file.attribute(key, words);
  for (std::size_t v = 0; v < variables_.size(); ++v) {
    const NetcdfVariable& variable = variables_[v];
    if (count_of(variable.dimensions) == 0) continue;
    if (variable.type == NetcdfType::real)
      file.put(made[v], 0, variable.reals);
    else if (variable.type == NetcdfType::text)
      file.put(made[v], 0, variable.texts);
    else
      file.put(made[v], 0, variable.numbers);
  }
  file.close();
}

void write_netcdf(const NetcdfDataset& dataset, const std::string& path, bool overwrite) {
  WholeFile whole(path, overwrite);
  dataset.write(whole.temporary(), path);
  whole.commit();
}

}  // namespace vegard::sim
