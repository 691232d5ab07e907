#include "fit/survey/survey_merge.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "fit/survey/survey_results.h"
#include "sim/base/error.h"
#include "sim/base/file/sha256.h"
#include "sim/base/file/whole_file.h"

namespace vegard::fit {
namespace {

/// A database that is open, with its reader.
struct OpenSurvey {
  explicit OpenSurvey(const std::string& name) : file(name, SqliteFile::Opening::read), reader(file) {}
  SqliteFile file;
  SurveyReader reader;
};

/// The database that was asked for last, which is most often the next as well.
class SurveyAtHand {
 public:
  const SurveyReader& of(const std::string& name) {
    if (!open_ || open_->file.name() != name) open_.emplace(name);
    return open_->reader;
  }

 private:
  std::optional<OpenSurvey> open_;
};

/// A block of one database.
struct BlockSource {
  std::size_t database = 0;  ///< its number among the sorted names
  std::size_t versions = 0;  ///< number among the sorted versions
  AnsweredBlock block;
};

/// Returns the digest of a block's frames, by which two databases are compared.
std::string digest_of(const SurveyReader& reader, const AnsweredBlock& block, int frames) {
  sim::Sha256 sum;
  const auto add = [&](const std::optional<std::string>& text) {
    sum.add(text ? std::to_string(text->size()) + ":" + *text : "-");
  };
  const auto add_number = [&](const std::optional<double>& number) {
    if (!number) return sum.add("-");
    sum.add("+");
    sum.add({reinterpret_cast<const char*>(&*number), sizeof *number});
  };
  reader.frames(block.first_frame, block.first_frame + frames, [&](const FrameAnswer& a) {
    add(std::to_string(a.frame) + frame_status_name(a.status) + a.camera + "/" + a.file);
    add_number(a.time_s);
    for (const auto* text : {&a.reason, &a.sha256, &a.decoding}) add(*text);
    for (const WorkAnswer& w : a.works) {
      add(survey_work_name(w.work) + w.verdict);
      for (const auto* text : {&w.words, &w.start, &w.physics}) add(*text);
      add_number(w.chi2_per_dof);
      add(std::to_string(w.seed.value_or(-1)));
      for (const double value : w.free_values) add_number(value);
      for (const SurveyQuantity& q : w.quantities) {
        add(std::to_string(q.item) + q.name);
        add(q.unit);
        add_number(q.value);
        add_number(q.sigma);
        for (const auto* text : {&q.trust, &q.reason}) add(*text);
      }
    }
  });
  return sum.digest();
}

/// The contents of the databases, without their rows.
struct Inventory {
  std::vector<std::string> names;                                     ///< of the databases, sorted
  std::map<std::pair<std::string, std::string>, AnsweredPlan> plans;  ///< by name and hash
  std::vector<SurveyVersions> versions;                               ///< sorted
  std::vector<std::pair<std::size_t, SurveyVersions>>
      origins;  ///< plan (its place in `plans`) and versions; sorted
  /// Of each plan's blocks, by the plan's place and the block's number.
  std::map<std::pair<std::size_t, int>, std::vector<BlockSource>> blocks;
};

bool is_same_plan(const AnsweredPlan& a, const AnsweredPlan& b) {
  const auto same_input = [](const PlanInput& x, const PlanInput& y) {
    return x.what == y.what && x.sha256 == y.sha256;
  };
  return a.frames == b.frames && a.blocks == b.blocks &&
         std::equal(a.inputs.begin(), a.inputs.end(), b.inputs.begin(), b.inputs.end(), same_input);
}

template <typename T>
void sort_once(std::vector<T>& all) {
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

Inventory take_stock(std::vector<std::string> names) {
  Inventory stock;
  sort_once(names);
  for (std::string& name : names)
    if (is_begun(SqliteFile(name, SqliteFile::Opening::read))) stock.names.push_back(std::move(name));
  if (stock.names.empty())
    throw sim::Error(sim::ErrorKind::usage, "no frame has been measured yet")
        .file(names.back())
        .hint("run the survey first");
  struct Found {
    std::pair<std::string, std::string> plan;
    std::vector<SurveyVersions> origins;
    std::vector<AnsweredBlock> blocks;
  };
  std::vector<Found> all;
  for (const std::string& name : stock.names) {
    const OpenSurvey survey(name);
    if (survey.reader.plans().size() != 1)
      throw sim::Error(sim::ErrorKind::usage, "is merged of several plans already")
          .file(name)
          .hint("merge what it was made of together with the rest");
    const AnsweredPlan& plan = survey.reader.plans().front();
    Found found;
    found.plan = {plan.name, plan.sha256};
    const auto [known, is_new] = stock.plans.emplace(found.plan, plan);
    if (!is_new && !is_same_plan(known->second, plan))
      throw sim::unreadable(name, "has another plan than others of the same hash");
    for (const SurveyReader::Origin& origin : survey.reader.origins()) {
      found.origins.push_back(origin.versions);
      stock.versions.push_back(origin.versions);
    }
    found.blocks = survey.reader.blocks();
    for (const AnsweredBlock& block : found.blocks)
      if (block.block >= plan.blocks || block.first_frame + block.frames > plan.frames ||
          block.done > block.frames)
        throw sim::unreadable(name, "has a block that its plan does not have");
    all.push_back(std::move(found));
  }
  sort_once(stock.versions);
  for (std::size_t d = 0; d < all.size(); ++d) {
    const auto plan =
        static_cast<std::size_t>(std::distance(stock.plans.begin(), stock.plans.find(all[d].plan)));
    for (const SurveyVersions& versions : all[d].origins) stock.origins.emplace_back(plan, versions);
    for (const AnsweredBlock& block : all[d].blocks) {
      const SurveyVersions& versions = all[d].origins[static_cast<std::size_t>(block.origin) - 1];
      const auto number = std::lower_bound(stock.versions.begin(), stock.versions.end(), versions);
      stock.blocks[{plan, block.block}].push_back(
          {d, static_cast<std::size_t>(number - stock.versions.begin()), block});
    }
  }
  sort_once(stock.origins);
  return stock;
}

void refuse_mixture(const Inventory& stock) {
  if (stock.plans.size() > 1)
    throw sim::Error(sim::ErrorKind::usage, "the databases are of " + std::to_string(stock.plans.size()) +
                                                " plans, '" + stock.plans.begin()->first.first + "' and '" +
                                                std::next(stock.plans.begin())->first.first + "' among them")
        .hint("--mixed merges them all the same");
  if (stock.versions.size() > 1)
    throw sim::Error(sim::ErrorKind::usage,
                     "the databases are of several versions: " + stock.versions[0].words() + "; and " +
                         stock.versions[1].words())
        .hint("--mixed merges them all the same");
}

/// Returns the source that a block is taken from. Throws if others of the same versions have other answers.
const BlockSource& chosen_source(std::vector<BlockSource>& sources, const Inventory& stock) {
  std::sort(sources.begin(), sources.end(), [](const BlockSource& a, const BlockSource& b) {
    return std::make_tuple(b.versions, b.block.done, a.database) <
           std::make_tuple(a.versions, a.block.done, b.database);
  });
  const BlockSource& first = sources.front();
  for (std::size_t i = 1; i < sources.size() && sources[i].versions == first.versions; ++i) {
    const std::string &name = stock.names[first.database], &other = stock.names[sources[i].database];
    const OpenSurvey a(name), b(other);
    const bool same_place = sources[i].block.first_frame == first.block.first_frame &&
                            sources[i].block.frames == first.block.frames;
    if (!same_place || digest_of(a.reader, first.block, sources[i].block.done) !=
                           digest_of(b.reader, sources[i].block, sources[i].block.done))
      throw sim::unreadable(other, "has other answers than '" + name + "' for frames of block " +
                                       std::to_string(first.block.block) + ", of the same plan and version");
  }
  return first;
}

void write_merged(Inventory& stock, SqliteFile& file, SurveyMerge& merge) {
  make_survey_tables(file);
  SurveyWriter writer(file);
  std::vector<std::pair<int, int>> firsts;  // frame and block, of each plan
  int first_frame = 0, first_block = 0;
  for (const auto& [key, plan] : stock.plans) {
    firsts.emplace_back(first_frame, first_block);
    writer.add_plan(static_cast<int>(firsts.size()), plan, first_frame, first_block);
    constexpr int kMax = std::numeric_limits<int>::max();
    if (plan.frames > kMax - first_frame || plan.blocks > kMax - first_block)
      throw sim::Error(sim::ErrorKind::usage, "there are more frames than can be numbered");
    first_frame += plan.frames;
    first_block += plan.blocks;
  }
  for (std::size_t o = 0; o < stock.origins.size(); ++o)
    writer.add_origin(static_cast<int>(o) + 1, static_cast<int>(stock.origins[o].first) + 1,
                      stock.origins[o].second);
  SurveyAtHand at_hand;
  for (auto& [key, sources] : stock.blocks) {
    const BlockSource& source = chosen_source(sources, stock);
    const int frame_offset = firsts[key.first].first, block_offset = firsts[key.first].second;
    const std::pair origin{key.first, stock.versions[source.versions]};
    const auto number =
        std::lower_bound(stock.origins.begin(), stock.origins.end(), origin) - stock.origins.begin();
    writer.add_block({source.block.block + block_offset, source.block.first_frame + frame_offset,
                      source.block.frames, 0, static_cast<int>(number) + 1});
    const std::string& name = stock.names[source.database];
    int next = source.block.first_frame;
    at_hand.of(name).frames(next, next + source.block.done, [&](const FrameAnswer& answer) {
      if (answer.frame != next || answer.block != source.block.block)
        throw sim::unreadable(name, "lacks a frame in the middle of a block");
      FrameAnswer moved = answer;
      moved.frame += frame_offset;
      moved.block += block_offset;
      writer.add_frame(moved);
      ++next;
      ++merge.frames;
    });
  }
  merge.lacking = first_frame - merge.frames;
}

}  // namespace

SurveyMerge merge_surveys(const std::vector<std::string>& databases, const std::string& output, bool mixed,
                          bool overwrite) {
  if (databases.empty()) throw sim::Error(sim::ErrorKind::usage, "there is no database to merge");
  sim::WholeFile whole(output, overwrite);
  Inventory stock = take_stock(databases);
  if (!mixed) refuse_mixture(stock);
  SurveyMerge merge;
  merge.databases = static_cast<int>(stock.names.size());
  merge.plans = static_cast<int>(stock.plans.size());
  merge.versions = static_cast<int>(stock.versions.size());
  {
    SqliteFile file(whole.temporary(), SqliteFile::Opening::make);
    file.transaction([&] { write_merged(stock, file, merge); });
  }
  whole.commit();
  return merge;
}

}  // namespace vegard::fit
