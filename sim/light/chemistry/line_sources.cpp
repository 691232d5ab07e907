#include "sim/light/chemistry/line_sources.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "sim/base/file/csv_table.h"

namespace vegard::sim {
namespace {

constexpr std::size_t kN2 = 0, kO2 = 1, kO = 2;
using Rate = std::vector<double>;
using R = Reaction;

/// Numbers of processes in data/electrons/emissions.csv. Beyond their tables that of 777.4 nm from O changes
/// the spin; the others go on as their last two rows do.
enum class ImpactLight { o_7774 = 400, o2_7774, o_8446, o2_8446 };

CollisionCurve impact_curve(ImpactLight process) {
  constexpr double kUnitCm2 = 1e-18;
  static const CsvTable table = embedded_csv_table("emissions.csv");
  const auto &numbers = table.column("process"), &energy = table.column("energy_eV"),
             &value = table.column("cross_section_1e-18_cm2");
  CollisionCurve curve;
  curve.tail = process == ImpactLight::o_7774 ? CollisionTail::exchange : CollisionTail::allowed;
  for (std::size_t r = 0; r < table.rows(); ++r)
    if (numbers[r] == static_cast<int>(process)) {
      curve.energy_ev.push_back(energy[r]);
      curve.cm2.push_back(kUnitCm2 * value[r]);
    }
  curve.loss_ev = curve.energy_ev.front();
  return curve;
}

ReactingAir reacting_air(const FieldAir& column, std::size_t m) {
  ReactingAir air;
  air.altitude_km = column.altitude_km[m];
  air.temperature_k = column.temperature_k[m];
  air.electron_temperature_k = column.electron_temperature_k[m];
  air.n2 = column.density_cm3[kN2][m];
  air.o2 = column.density_cm3[kO2][m];
  air.o = column.density_cm3[kO][m];
  air.no = column.no_cm3[m];
  air.n = column.n_cm3[m];
  return air;
}

/// The light that the electrons of `rates` excite in the air of `column`.
class LightOfElectrons {
 public:
  LightOfElectrons(const Degradation& degradation, const FieldAir& column, const ElectronRates& rates,
                   const Reactions& reactions, double seconds)
      : degradation_(degradation), column_(column), rates_(rates), reactions_(reactions) {
    for (std::size_t m = 0; m < column.size(); ++m) {
      air_.push_back(reacting_air(column, m));
      at_.push_back(reactions.at(air_[m].temperature_k, air_[m].electron_temperature_k));
      ions_.push_back(ion_history(air_[m], production(m), reactions, seconds));
      night_.push_back(ion_history(air_[m], {}, reactions, seconds));
      light_.ions.push_back(ions_.back().ions.back());
    }
  }

  AuroralLight run() {
    const Rate o2_7774 = impact(kO2, ImpactLight::o2_7774);
    const Rate blue = scaled(shell(kN2, "N2+ B"), photons_4278_of_shell());
    add("ver_3371", 337.1, {{"N2 + e, to C3Pi", scaled(excited(kN2, "N2 C3Pi"), value(R::light_3371))}});
    add("ver_4278", 427.8, {{"N2 + e, to N2+(B)", blue}});
    nitrogen_2d();
    oxygen_1s(o2_7774);
    oxygen_1d();
    const double bands = value(R::light_6705), w3delta_share = value(R::b_of_w);
    add("ver_6705", 670.5,
        {{"N2 + e, to B3Pi", scaled(excited(kN2, "N2 B3Pi"), bands)},
         {"from C3Pi", scaled(excited(kN2, "N2 C3Pi"), bands)},
         {"from B'3Sigma", scaled(excited(kN2, "N2 B'3Sigma"), bands)},
         {"from W3Delta", scaled(excited(kN2, "N2 W3Delta"), bands * w3delta_share)}});
    add("ver_7774", 777.4, {{"O + e", impact(kO, ImpactLight::o_7774)}, {"O2 + e", o2_7774}});
    add("ver_8446", 844.6,
        {{"O + e", impact(kO, ImpactLight::o_8446)}, {"O2 + e", impact(kO2, ImpactLight::o2_8446)}});
    return std::move(light_);
  }

 private:
  double value(Reaction reaction) const { return reactions_.value(reaction); }
  std::size_t places() const { return column_.size(); }

  void add(const char* column, double nm, std::vector<LineSource> sources, const Rate& losses_s = {}) {
    light_.lines.push_back({column, nm, std::move(sources), losses_s});
    for (double& lifetime : light_.lines.back().lifetime_s) lifetime = 1.0 / lifetime;
  }

  static Rate scaled(Rate rate, double factor) {
    for (double& r : rate) r *= factor;
    return rate;
  }

  template <class Function>
  Rate by_place(const Function& rate_at) const {
    Rate rate(places());
    for (std::size_t m = 0; m < places(); ++m) rate[m] = rate_at(m);
    return rate;
  }

  /// Returns the rate of an excitation by its name in sim/light/transport/collisions.cpp.
  const Rate& excited(std::size_t gas, const char* name) const {
    const auto& excitations = degradation_.collisions[gas].excitations;
    for (std::size_t e = 0; e < excitations.size(); ++e)
      if (excitations[e].name == name) return rates_.excitation_cm3_s[gas][e];
    assert(false);
    return rates_.excitation_cm3_s[gas][0];
  }

  const Rate& shell(std::size_t gas, const char* name) const {
    const auto& shells = degradation_.collisions[gas].shells;
    for (std::size_t s = 0; s < shells.size(); ++s)
      if (shells[s].name == name) return rates_.shell_cm3_s[gas][s];
    assert(false);
    return rates_.shell_cm3_s[gas][0];
  }

  Rate impact(std::size_t gas, ImpactLight process) const {
    const CollisionCurve curve = impact_curve(process);
    const double factor = degradation_.factor(static_cast<int>(process));
    Rate rate(places(), 0.0);
    for (std::size_t j = 0; j < degradation_.grid.size(); ++j) {
      const double cm2 = factor * curve.at(degradation_.grid.energy_ev[j]);
      if (cm2 <= 0.0) continue;
      for (std::size_t m = 0; m < places(); ++m) rate[m] += cm2 * rates_.flux[j][m];
    }
    for (std::size_t m = 0; m < places(); ++m) rate[m] *= column_.density_cm3[gas][m];
    return rate;
  }

  /// Returns the photons of 427.8 nm per ionisation of the shell that leaves N2+(B).
  double photons_4278_of_shell() const {
    constexpr double kMeasuredEv = 100.0, kUnitCm2 = 1e-18;
    const GasCollisions& n2 = degradation_.collisions[kN2];
    for (const IonisedShell& s : n2.shells)
      if (s.name == "N2+ B")
        return kUnitCm2 * value(R::light_3914) * value(R::light_4278) /
               (n2.shell_factor(kMeasuredEv) * ShellSpectrum(s, kMeasuredEv).cm2());
    assert(false);
    return 0.0;
  }

  double ionised(std::size_t gas, std::size_t m) const {
    double sum = 0.0;
    for (const Rate& shell : rates_.shell_cm3_s[gas]) sum += shell[m];
    return sum;
  }

  IonProduction production(std::size_t m) const {
    const double n2 = ionised(kN2, m), o2 = ionised(kO2, m);
    IonProduction p;
    p.np = value(R::np_share) * n2;
    p.n2p = n2 - p.np;
    p.op = value(R::op_share) * o2 + shell(kO, "O+ 4S")[m] + shell(kO, "O+ 2s2p4")[m] + shell(kO, "O 1s")[m];
    p.o2p = (1.0 - value(R::op_share)) * o2;
    p.op2d = shell(kO, "O+ 2D")[m];
    p.op2p = shell(kO, "O+ 2P")[m];
    return p;
  }

  /// Densities of atoms, cm^-3, or their losses, s^-1: [place][moment].
  using Course = std::vector<Rate>;

  template <class Function>
  Course course(const Function& at_moment) const {
    Course result(places());
    for (std::size_t m = 0; m < places(); ++m)
      for (std::size_t t = 0; t < ions_[m].ions.size(); ++t) result[m].push_back(at_moment(m, t));
    return result;
  }

  struct AtomSource {
    const char* name;
    Course made_cm3_s;
  };

  /// Adds a line of atoms that live long: A times what of each source is there at the last moment. Returns
  /// the densities of all sources.
  Course add_slow(const char* column, double nm, Reaction light, const Course& losses_s,
                  const std::vector<AtomSource>& sources) {
    Course atoms_cm3 = course([](std::size_t, std::size_t) { return 0.0; });
    std::vector<LineSource> shining;
    for (const AtomSource& source : sources) {
      shining.push_back({source.name, Rate(places())});
      for (std::size_t m = 0; m < places(); ++m) {
        const Rate atoms = atoms_since_onset(ions_[m].step_s, source.made_cm3_s[m], losses_s[m]);
        for (std::size_t t = 0; t < atoms.size(); ++t) atoms_cm3[m][t] += atoms[t];
        shining.back().photons_cm3_s[m] = at_[m](light) * atoms.back();
      }
    }
    add(column, nm, std::move(shining), by_place([&](std::size_t m) { return losses_s[m].back(); }));
    return atoms_cm3;
  }

  void nitrogen_2d() {
    const Rate &a2 = excited(kN2, "N2 a''1Sigma"), &singlets = excited(kN2, "N2 singlets from 13 eV");
    const Course losses_s = course([&](std::size_t m, std::size_t t) {
      const auto& k = at_[m];
      return k(R::n2d_5200) + k(R::n2d_o2) * air_[m].o2 + k(R::n2d_o) * air_[m].o +
             k(R::n2d_no) * air_[m].no + k(R::n2d_e) * now(m, t).electrons;
    });
    n2d_cm3_ = add_slow(
        "ver_5200", 520.0, R::n2d_5200, losses_s,
        {{"N2+ + O", course([&](std::size_t m, std::size_t t) {
            return at_[m](R::n2p_o) * air_[m].o * (now(m, t).n2p - night(m, t).n2p);
          })},
         {"N2+ + e", course([&](std::size_t m, std::size_t t) {
            return value(R::n2d_of_n2p) * at_[m](R::n2p_e) * recombining(m, t, &IonDensities::n2p);
          })},
         {"NO+ + e", course([&](std::size_t m, std::size_t t) {
            return value(R::n2d_of_nop) * at_[m].nop_e() * recombining(m, t, &IonDensities::nop);
          })},
         {"N2 + e",
          course([&](std::size_t m, std::size_t) { return value(R::n2d_of_n2) * (a2[m] + singlets[m]); })},
         {"N2 + e, to N+", course([&](std::size_t m, std::size_t) {
            return value(R::n2d_of_np) * value(R::np_share) * ionised(kN2, m);
          })}});
  }

  void oxygen_1s(const Rate& o2_7774) {
    Rate n2a(places(), 0.0);
    for (const char* state : {"N2 A3Sigma v=0-4", "N2 A3Sigma v=5-9", "N2 A3Sigma v=10-", "N2 B3Pi",
                              "N2 W3Delta", "N2 B'3Sigma", "N2 C3Pi", "N2 E3Sigma"})
      for (std::size_t m = 0; m < places(); ++m) n2a[m] += excited(kN2, state)[m];
    const Course losses_s = course([&](std::size_t m, std::size_t) {
      const auto& k = at_[m];
      return k(R::o1s_5577) + k(R::o1s_2972) + k(R::o1s_o2) * air_[m].o2 + k(R::o1s_o) * air_[m].o;
    });
    const Rate& impact = excited(kO, "O 1S");
    o1s_cm3_ = add_slow(
        "ver_5577", 557.7, R::o1s_5577, losses_s,
        {{"O + e", course([&](std::size_t m, std::size_t) { return impact[m]; })},
         {"O2+ + e",
          course([&](std::size_t m, std::size_t t) { return value(R::o1s_of_o2p) * o2p_recombined(m, t); })},
         {"N2(A) + O", course([&](std::size_t m, std::size_t) {
            const double by_o = at_[m](R::n2a_o) * air_[m].o;
            return value(R::o1s_of_n2a) * n2a[m] * by_o /
                   (by_o + at_[m](R::n2a_o2) * air_[m].o2 + at_[m](R::n2a_light));
          })},
         {"O2 + e", course([&](std::size_t m, std::size_t) { return value(R::o1s_of_o2) * o2_7774[m]; })},
         {"O2+ + N", course([&](std::size_t m, std::size_t t) {
            return value(R::o1s_of_o2p_n) * at_[m](R::o2p_n) * air_[m].n * (now(m, t).o2p - night(m, t).o2p);
          })},
         {"N+ + O2",
          course([&](std::size_t m, std::size_t t) { return value(R::o1s_of_np) * np_o2(m, t); })}});
  }

  void oxygen_1d() {
    const Course losses_s = course([&](std::size_t m, std::size_t t) {
      const auto& k = at_[m];
      return k(R::o1d_6300) + k(R::o1d_6364) + k(R::o1d_n2) * air_[m].n2 + k(R::o1d_o2) * air_[m].o2 +
             k(R::o1d_o) * air_[m].o + k(R::o1d_e) * now(m, t).electrons;
    });
    const Rate &impact = excited(kO, "O 1D"), &dissociated = excited(kO2, "O2 8.4 eV");
    add_slow(
        "ver_6300", 630.0, R::o1d_6300, losses_s,
        {{"O + e", course([&](std::size_t m, std::size_t) { return impact[m]; })},
         {"O2+ + e",
          course([&](std::size_t m, std::size_t t) { return value(R::o1d_of_o2p) * o2p_recombined(m, t); })},
         {"N(2D) + O2", course([&](std::size_t m, std::size_t t) {
            return value(R::o1d_of_n2d) * at_[m](R::n2d_o2) * air_[m].o2 * n2d_cm3_[m][t];
          })},
         {"O(1S)",
          course([&](std::size_t m, std::size_t t) { return at_[m](R::o1s_5577) * o1s_cm3_[m][t]; })},
         {"N+ + O2", course([&](std::size_t m, std::size_t t) { return value(R::o1d_of_np) * np_o2(m, t); })},
         {"O2 + e",
          course([&](std::size_t m, std::size_t) { return value(R::o1d_of_o2) * dissociated[m]; })}});
  }

  const IonDensities& now(std::size_t m, std::size_t t) const { return ions_[m].ions[t]; }
  const IonDensities& night(std::size_t m, std::size_t t) const { return night_[m].ions[t]; }

  double o2p_recombined(std::size_t m, std::size_t t) const {
    return at_[m].o2p_e() * recombining(m, t, &IonDensities::o2p);
  }
  double np_o2(std::size_t m, std::size_t t) const {
    return at_[m](R::np_o2) * air_[m].o2 * (now(m, t).np - night(m, t).np);
  }

  /// Returns the product of the densities of electrons and an ion, less that of a night without aurora, whose
  /// light is not the electrons': the airglow.
  double recombining(std::size_t m, std::size_t t, double IonDensities::*ion) const {
    const IonDensities &with = now(m, t), &without = night(m, t);
    return std::max(0.0, with.electrons * with.*ion - without.electrons * without.*ion);
  }

  const Degradation& degradation_;
  const FieldAir& column_;
  const ElectronRates& rates_;
  const Reactions& reactions_;
  std::vector<ReactingAir> air_;
  std::vector<RatesAtPlace> at_;
  std::vector<IonHistory> ions_, night_;  // with and without the electrons that fall
  Course n2d_cm3_, o1s_cm3_;
  AuroralLight light_;
};

}  // namespace

std::vector<double> SourcedLine::photons_cm3_s() const {
  std::vector<double> sum(sources.front().photons_cm3_s.size(), 0.0);
  for (const LineSource& source : sources)
    for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += source.photons_cm3_s[m];
  return sum;
}

double column_rayleigh(const FieldAir& column, const std::vector<double>& photons_cm3_s) {
  // The path along the field is longer than the altitude by the same factor everywhere.
  const double slant = 1e-5 * (column.path_cm.back() - column.path_cm.front()) /
                       (column.altitude_km.back() - column.altitude_km.front());
  return 1e-6 * path_integral(column, photons_cm3_s) / slant;
}

AuroralRun auroral_run(const Degradation& degradation, FieldAir column, const std::vector<double>& flux,
                       PitchAngles angles, const Reactions& reactions, double seconds) {
  AuroralRun run;
  run.column = std::move(column);
  run.column.electrons_cm3.clear();
  const auto compute = [&] {
    run.rates = electron_transport(degradation, run.column, flux, angles);
    run.light = LightOfElectrons(degradation, run.column, run.rates, reactions, seconds).run();
  };
  compute();
  for (const IonDensities& ions : run.light.ions) run.column.electrons_cm3.push_back(ions.electrons);
  compute();
  return run;
}

}  // namespace vegard::sim
