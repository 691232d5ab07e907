// Collects blocks with light over the spans of a bundle until sixteen can be computed together.
#if defined(VEGARD_SIM_EMIT_FOOTPRINT_FOOTPRINT_QUEUE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGARD_SIM_EMIT_FOOTPRINT_FOOTPRINT_QUEUE_INL_H_
#undef VEGARD_SIM_EMIT_FOOTPRINT_FOOTPRINT_QUEUE_INL_H_
#else
#define VEGARD_SIM_EMIT_FOOTPRINT_FOOTPRINT_QUEUE_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <limits>

#include "sim/emit/footprint/footprint_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegard::sim {
namespace HWY_NAMESPACE {

/// Light, and light times distance, of a span.
template <int kQuartets>
class SpanSum {
 public:
  HWY_INLINE SpanSum() {
    for (int p = 0; p < kParts; ++p) light_[p] = moment_[p] = hn::Zero(FloatTag());
  }

  HWY_INLINE void add(const BlockSum& sum, const MarchSpan& span, int block) {
    const FloatTag d;
    const double from_km = span.first_km + block * kBlockSteps * span.step_km;
    // The sum over units u = 0, 1, ... of u x_u equals their number times the sum of x_u, less the sum of
    // partial sums.
    const auto last = hn::Set(d, static_cast<float>(from_km + (kBlockSteps + 0.5) * span.step_km));
    const auto unit = hn::Set(d, static_cast<float>(2.0 / kQuartets * span.step_km));
    for (int p = 0; p < kParts; ++p) {
      light_[p] = hn::Add(light_[p], sum.plain[p]);
      moment_[p] = hn::Add(moment_[p], hn::Sub(hn::Mul(sum.plain[p], last), hn::Mul(sum.running[p], unit)));
    }
    if (has_entered_ || is_dark()) return;
    has_entered_ = true;
    entry_km_ = span.at_km + from_km;
  }

  HWY_INLINE void finish(const MarchSpan& span, SpanLight& out) const {
    const FloatTag d;
    HWY_ALIGN float light[16], moment[16];
    for (int p = 0; p < kParts; ++p) {
      hn::Store(light_[p], d, light + p * kLanes);
      hn::Store(moment_[p], d, moment + p * kLanes);
    }
    const double scale = kRayleighsPerKm * span.step_km;
    for (int i = 0; i < 16; ++i) {
      // The second of a unit's two steps is one step farther.
      const double place_km = span.at_km + (kQuartets == 1 && i >= 8 ? span.step_km : 0.0);
      out.rayleigh[i % (4 * kQuartets)] += scale * light[i];
      out.weighted_km += scale * (moment[i] + place_km * light[i]);
    }
    out.entry_km = entry_km_;
  }

 private:
  HWY_INLINE bool is_dark() const {
    const FloatTag d;
    for (int p = 0; p < kParts; ++p)
      if (!hn::AllTrue(d, hn::Eq(light_[p], hn::Zero(d)))) return false;
    return true;
  }

  Sixteen light_, moment_;
  bool has_entered_ = false;
  double entry_km_ = std::numeric_limits<double>::infinity();
};

/// Takes blocks span by span, and within each span in their order.
class LightQueue {
 public:
  HWY_INLINE explicit LightQueue(const StepProfile& profile) : profile_(profile) {}

  /// `places_of(number of a step)` gives the places of as many steps as there are lanes.
  template <class PlacesOf>
  HWY_INLINE void push(const TexelWindow& window, std::size_t span, int block, int width,
                       const PlacesOf& places_of) {
    if (slots_ == 16) light_all();
    for (int part = 0; part < kBlockSteps; part += kLanes)
      keep_places(places_of(part), window, profile_, slots_, part, steps_);
    slot_[slots_++] = {&window, span, block, width};
    ++blocks_;
  }

 protected:
  struct Slot {
    const TexelWindow* window;
    std::size_t span;
    int block, width;
  };
  ~LightQueue() = default;
  /// Adds up the light of the slots and empties them.
  virtual void light_all() = 0;

  const StepProfile& profile_;
  Steps steps_;
  Slot slot_[16];
  int slots_ = 0;
  std::size_t blocks_ = 0;
};

/// A LightQueue for so many quartets of lines, of one energy or of several.
template <int kQuartets, bool kEnergies>
class LightQueueOf final : public LightQueue {
 public:
  /// `out` has an entry for each span, initially dark.
  HWY_INLINE LightQueueOf(const StepProfile& profile, const MarchSpan* spans, SpanLight* out)
      : LightQueue(profile), spans_(spans), out_(out) {}

  /// Returns the number of steps that were pushed.
  HWY_INLINE std::size_t finish() {
    light_all();
    if (blocks_ > 0) sum_.finish(spans_[open_], out_[open_]);
    return blocks_ * kBlockSteps;
  }

 private:
  HWY_NOINLINE void light_all() override {
    RowWeights<kEnergies> weights;
    for (int i = 0; i < slots_; ++i) find_weights<kEnergies>(*slot_[i].window, profile_, i, steps_, weights);
    const WeightLanes<kQuartets> lanes;
    for (int i = 0; i < slots_; ++i) {
      const Slot& slot = slot_[i];
      if (slot.span != open_) {
        if (open_ != kNone) sum_.finish(spans_[open_], out_[open_]);
        sum_ = SpanSum<kQuartets>();
        open_ = slot.span;
      }
      BlockSum sum;
      add_rows<kQuartets, kEnergies>(profile_, slot.width, i, steps_, weights, lanes, sum);
      sum_.add(sum, spans_[open_], slot.block);
    }
    slots_ = 0;
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  const MarchSpan* spans_;
  SpanLight* out_;
  std::size_t open_ = kNone;
  SpanSum<kQuartets> sum_;  ///< light of the span `open_`
};

}  // namespace HWY_NAMESPACE
}  // namespace vegard::sim
HWY_AFTER_NAMESPACE();

#endif
