#include "fit/search/file_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "sim/base/error.h"
#include "sim/base/file/durable_rename.h"
#include "sim/base/file/sha256.h"
#include "sim/base/text.h"

namespace vegard::fit {

namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr off_t kMaxJournalBytes = off_t{1} << 30;

std::string header_line(const JournalSubject& subject) {
  Json json;
  json["journal"] = kFormat;
  json["of"] = Json::object();
  for (const auto& [name, value] : subject) json["of"][name] = value;
  return checked_line(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

sim::Error refused(const std::string& file, const std::string& problem, const std::string& hint) {
  return sim::Error(sim::ErrorKind::existing_output, problem).file(file).hint(hint);
}

/// In what two headers differ, in words.
std::string difference(const Json& mine, const Json& theirs) {
  if (mine.value("journal", Json()) != theirs.value("journal", Json())) return "has another format";
  const Json a = mine.value("of", Json::object()), b = theirs.value("of", Json::object());
  if (!b.is_object()) return "has another format";
  for (const auto& [name, value] : a.items())
    if (b.value(name, Json()) != value) return "is the journal of another fit: " + name + " differs";
  return "is the journal of another fit";
}

std::string all_of(int descriptor, const std::string& file) {
  std::string bytes;
  char buffer[1 << 16];
  while (true) {
    const ssize_t count = ::pread(descriptor, buffer, sizeof buffer, static_cast<off_t>(bytes.size()));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw sim::unwritable(file, errno);
    if (count == 0) return bytes;
    bytes.append(buffer, static_cast<std::size_t>(count));
  }
}

/// Returns an errno value.
int write_at(int descriptor, const std::string& bytes, long long at) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::pwrite(descriptor, bytes.data() + done, bytes.size() - done,
                                   static_cast<off_t>(at + static_cast<long long>(done)));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    done += static_cast<std::size_t>(count);
  }
  return ::fdatasync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
}

}  // namespace

std::string journal_file(const std::string& run_directory) {
  std::string path = run_directory;
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path + ".part";
}

FileJournal::FileJournal(const std::string& file, const JournalSubject& subject, JournalMode mode)
    : file_(file) {
  try {
    open(subject, mode);
  } catch (...) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw;
  }
}

void FileJournal::open(const JournalSubject& subject, JournalMode mode) {
  std::error_code trouble;
  const std::string folder = fs::path(file_).parent_path().string();
  for (fs::path missing = folder; !missing.empty() && !fs::exists(missing, trouble);
       missing = missing.parent_path())
    made_folders_.push_back(missing.string());
  trouble.clear();
  if (!folder.empty()) fs::create_directories(folder, trouble);
  if (trouble) throw sim::unwritable(file_, trouble.value());
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
  if (descriptor_ < 0) throw sim::unwritable(file_, errno);
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode))
    throw refused(file_, "is in the way of the fit's journal", "choose another name for the run");
  if (status.st_size > kMaxJournalBytes)
    throw refused(file_, "is in the way of the fit's journal: it has more than 1 GB",
                  "choose another name for the run");
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw refused(file_, "is in use by a fit that is at work", "wait for it, or choose another name");

  const std::string header = header_line(subject), bytes = all_of(descriptor_, file_);
  const std::size_t line = bytes.find('\n');
  // A header that was torn while it was written is one of ours, and holds nothing.
  const bool nothing = line == std::string::npos && sim::starts_with(header, bytes);
  const std::optional<std::string> text =
      line == std::string::npos ? std::nullopt : checked_text(bytes.substr(0, line));
  const Json found = text ? Json::parse(*text, nullptr, false) : Json();
  if (!nothing && !(found.is_object() && found.contains("journal")))
    throw refused(file_, "is in the way of the fit's journal, and is none itself",
                  "choose another name for the run");
  const bool same = sim::starts_with(bytes, header);
  if (same) read_steps(bytes, header.size());
  const bool has_steps = !nothing && bytes.size() > line + 1;
  if (mode == JournalMode::fresh && has_steps)
    throw refused(
        file_, "holds the finished steps of a fit that was cut off",
        "use --resume to go on with it, --overwrite to begin again, or choose another name for the run");
  if (mode == JournalMode::resume && has_steps && !same)
    throw refused(file_, difference(Json::parse(*checked_text(header.substr(0, header.size() - 1))), found),
                  "call it as before, or use --overwrite without --resume to begin again");
  if (mode != JournalMode::resume || !same) {
    steps_.clear();
    dropped_ = 0;
    if (::ftruncate(descriptor_, 0) != 0) throw sim::unwritable(file_, errno);
    if (const int error = write_at(descriptor_, header, 0); error != 0) {
      unlink();
      throw sim::unwritable(file_, error);
    }
    end_ = static_cast<long long>(header.size());
    sim::make_durable(folder.empty() ? "." : folder);
  } else if (::ftruncate(descriptor_, end_) != 0) {
    throw sim::unwritable(file_, errno);
  }
  found_ = static_cast<int>(steps_.size());
}

FileJournal::~FileJournal() {
  if (descriptor_ < 0) return;
  if (steps_.empty()) unlink();
  ::close(descriptor_);
}

void FileJournal::unlink() {
  ::unlink(file_.c_str());
  std::error_code in_use;
  for (const std::string& folder : made_folders_) fs::remove(folder, in_use);
}

void FileJournal::remove() {
  if (descriptor_ < 0) return;
  unlink();
  ::close(descriptor_);
  descriptor_ = -1;
}

void FileJournal::read_steps(const std::string& bytes, std::size_t begin) {
  int line_number = 1;  // the header's
  while (true) {
    ++line_number;
    end_ = static_cast<long long>(begin);
    const std::size_t line = bytes.find('\n', begin);
    if (line == std::string::npos) return;
    const std::optional<std::string> text = checked_text(bytes.substr(begin, line - begin));
    auto step = text ? step_of_text(*text) : std::nullopt;
    if (!step) {
      dropped_ =
          static_cast<int>(std::count(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.end(), '\n'));
      why_dropped_ = "line " + std::to_string(line_number) + " of " + file_ +
                     (text ? " is no step of this version" : " does not have the checksum that it gives");
      return;
    }
    step->second.kept_in = file_ + " (" + step->first + ")";
    steps_.insert(std::move(*step));
    begin = line + 1;
  }
}

const StepOutput* FileJournal::stored(const std::string& name) const {
  const auto found = steps_.find(name);
  return found == steps_.end() ? nullptr : &found->second;
}

void FileJournal::store(const std::string& name, const StepOutput& output) {
  if (!problem_.empty() || descriptor_ < 0) return;
  append(checked_line(step_text(name, output)));
  if (problem_.empty()) steps_[name] = output;
}

void FileJournal::append(const std::string& line) {
  if (const int error = write_at(descriptor_, line, end_); error != 0) {
    problem_ = sim::unwritable(file_, error).what();
    // Half a line would be dropped by a reader too.
    static_cast<void>(::ftruncate(descriptor_, end_) == 0);
    return;
  }
  end_ += static_cast<long long>(line.size());
}

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kChecksumDigits = 64;
constexpr std::size_t kDoubleDigits = 16;

std::string bits(const std::vector<double>& values) {
  std::string text;
  text.reserve(kDoubleDigits * values.size());
  for (const double value : values) {
    std::uint64_t word;
    std::memcpy(&word, &value, sizeof word);
    text += fmt::format("{:016x}", word);
  }
  return text;
}

/// Throws std::invalid_argument.
std::vector<double> doubles(const std::string& text) {
  if (text.size() % kDoubleDigits != 0) throw std::invalid_argument("no doubles");
  std::vector<double> values(text.size() / kDoubleDigits);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const char* begin = text.data() + kDoubleDigits * i;
    std::uint64_t word = 0;
    const auto [end, error] = std::from_chars(begin, begin + kDoubleDigits, word, 16);
    if (error != std::errc() || end != begin + kDoubleDigits) throw std::invalid_argument("no doubles");
    std::memcpy(&values[i], &word, sizeof word);
  }
  return values;
}

double one_double(const std::string& text) { return doubles(text).at(0); }

}  // namespace

std::string checked_line(const std::string& text) { return sim::sha256(text) + " " + text + "\n"; }

std::optional<std::string> checked_text(const std::string& line) {
  if (line.size() <= kChecksumDigits || line[kChecksumDigits] != ' ') return {};
  std::string text = line.substr(kChecksumDigits + 1);
  if (line.compare(0, kChecksumDigits, sim::sha256(text)) != 0) return {};
  return text;
}

std::string step_text(const std::string& name, const StepOutput& output) {
  Json json;
  json["step"] = name;
  json["numbers"] = Json::object();
  for (const auto& [key, values] : output.numbers) json["numbers"][key] = bits(values);
  json["words"] = output.words;
  json["flags"] = output.flags;
  json["trace"] = Json::array();
  for (const TraceRow& row : output.trace)
    json["trace"].push_back({row.stage, row.evaluation, bits({row.chi2}), bits(row.values)});
  json["books"] = {output.counters.residuals, output.counters.jacobians, bits({output.counters.best_chi2}),
                   output.counters.best_is_full, bits(output.counters.best_values)};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<std::pair<std::string, StepOutput>> step_of_text(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    StepOutput output;
    for (const auto& [key, values] : json.at("numbers").items())
      output.numbers[key] = doubles(values.get<std::string>());
    output.words = json.at("words").get<std::map<std::string, std::string>>();
    output.flags = json.at("flags").get<std::map<std::string, bool>>();
    for (const Json& row : json.at("trace"))
      output.trace.push_back({row.at(0).get<std::string>(), row.at(1).get<int>(),
                              one_double(row.at(2).get<std::string>()),
                              doubles(row.at(3).get<std::string>())});
    const Json& books = json.at("books");
    output.counters = {books.at(0).get<int>(), books.at(1).get<int>(),
                       one_double(books.at(2).get<std::string>()), books.at(3).get<bool>(),
                       doubles(books.at(4).get<std::string>())};
    return std::make_pair(json.at("step").get<std::string>(), output);
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace vegard::fit
