#include <cstring>
#include <utility>

#include "sim/base/array/array_format.h"
#include "sim/base/error.h"
#include "sim/base/file/child_worker.h"

namespace vegard::sim {
namespace {

enum class Request : std::uint64_t { list, block, texts };

/// Numbers and texts one after another, between two copies of one program.
class Sent {
 public:
  void add(std::uint64_t number) { bytes_.append(reinterpret_cast<const char*>(&number), sizeof number); }
  void add(const std::string& text) {
    add(text.size());
    bytes_ += text;
  }
  void add(const std::vector<std::uint64_t>& numbers) {
    add(numbers.size());
    for (const std::uint64_t number : numbers) add(number);
  }
  void add(const ArrayWords& words) {
    add(words.size());
    for (const auto& [key, value] : words) {
      add(key);
      add(value);
    }
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads the child's answer, which is not trusted: the file may have damaged the child.
class Received {
 public:
  Received(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}
  std::uint64_t number() {
    std::uint64_t value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() { return std::string(take(number())); }
  std::vector<std::uint64_t> numbers() {
    std::vector<std::uint64_t> values(count(sizeof(std::uint64_t)));
    for (std::uint64_t& value : values) value = number();
    return values;
  }
  ArrayWords words() {
    ArrayWords values(count(2 * sizeof(std::uint64_t)));
    for (auto& [key, value] : values) {
      key = text();
      value = text();
    }
    return values;
  }
  /// A number of things, each of which takes so many bytes at least.
  std::size_t count(std::size_t bytes_each) {
    const std::uint64_t things = number();
    if (things > bytes_.size() / bytes_each) throw bad_answer();
    return static_cast<std::size_t>(things);
  }
  Error bad_answer() const { return damaged(file_, "its library fails on it"); }

 private:
  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size()) throw bad_answer();
    const std::string_view taken = bytes_.substr(0, static_cast<std::size_t>(size));
    bytes_.remove_prefix(taken.size());
    return taken;
  }
  std::string_view bytes_;
  const std::string& file_;
};

std::string listing(const ArrayFile& file) {
  Sent sent;
  sent.add(std::string(file.format()));
  sent.add(file.arrays().size());
  for (const StoredArray& array : file.arrays()) {
    sent.add(array.name);
    sent.add(array.dims);
    sent.add(static_cast<std::uint64_t>(array.kind));
    sent.add(static_cast<std::uint64_t>(array.clock));
    sent.add(array.columns_first ? 1 : 0);
    sent.add(array.words);
  }
  sent.add(file.words().size());
  for (const auto& [group, words] : file.words()) {
    sent.add(group);
    sent.add(words);
  }
  return sent.take();
}

std::string answer_of(ArrayFile& file, std::string_view request) {
  Received received(request, file.name());
  const auto kind = static_cast<Request>(received.number());
  if (kind == Request::list) return listing(file);
  const StoredArray& array = file.arrays()[static_cast<std::size_t>(received.number())];
  if (kind == Request::block) {
    const std::vector<std::uint64_t> start = received.numbers();
    return file.read(array, start, received.numbers());
  }
  Sent sent;
  const std::vector<std::string> texts = file.read_texts(array);
  sent.add(texts.size());
  for (const std::string& text : texts) sent.add(text);
  return sent.take();
}

class GuardedArrayFile : public ArrayFile {
 public:
  GuardedArrayFile(const std::string& name, const char* format, const char* library,
                   std::function<std::unique_ptr<ArrayFile>()> open)
      : ArrayFile(name, format),
        worker_(
            name, library,
            [open = std::move(open), file = std::shared_ptr<ArrayFile>()](std::string_view request) mutable {
              if (file == nullptr) file = open();
              return answer_of(*file, request);
            }) {
    Sent request;
    request.add(static_cast<std::uint64_t>(Request::list));
    const std::string listed = worker_.ask(request.take());
    Received received(listed, name_);
    told_format_ = received.text();
    format_ = told_format_.c_str();
    arrays_.resize(received.count(6 * sizeof(std::uint64_t)));
    for (StoredArray& array : arrays_) {
      array.name = received.text();
      array.dims = received.numbers();
      array.kind = static_cast<ArrayKind>(received.number());
      array.clock = static_cast<ArrayClock>(received.number());
      if (array.kind > ArrayKind::text || array.clock > ArrayClock::tt2000) throw received.bad_answer();
      array.columns_first = received.number() != 0;
      array.words = received.words();
    }
    for (std::size_t groups = received.count(2 * sizeof(std::uint64_t)); groups > 0; --groups) {
      const std::string group = received.text();
      words_[group] = received.words();
    }
  }

  std::vector<std::string> read_texts(const StoredArray& array) override {
    Sent request;
    request.add(static_cast<std::uint64_t>(Request::texts));
    request.add(index_of(array));
    const std::string bytes = worker_.ask(request.take());
    Received received(bytes, name_);
    std::vector<std::string> texts(received.count(sizeof(std::uint64_t)));
    for (std::string& text : texts) text = received.text();
    return texts;
  }

 private:
  std::uint64_t index_of(const StoredArray& array) const {
    return static_cast<std::uint64_t>(&array - arrays_.data());
  }

  std::string read_block(const StoredArray& array, const std::vector<std::uint64_t>& start,
                         const std::vector<std::uint64_t>& count) override {
    Sent request;
    request.add(static_cast<std::uint64_t>(Request::block));
    request.add(index_of(array));
    request.add(start);
    request.add(count);
    return worker_.ask(request.take());
  }

  ChildWorker worker_;
  std::string told_format_;
};

}  // namespace

std::unique_ptr<ArrayFile> guarded(const std::string& name, const char* format, const char* library,
                                   std::function<std::unique_ptr<ArrayFile>()> open) {
  return std::make_unique<GuardedArrayFile>(name, format, library, std::move(open));
}

}  // namespace vegard::sim
