// Reactions of ions and excited atoms of the upper air: rate coefficients, yields, Einstein coefficients.
//
// Source: data/electrons/reactions.csv, which names the source of every number; docs/electrons.md.
// None of them is from GLOW's files.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>

namespace vegard::sim {

/// The numbers of the rows. "e" is a thermal electron.
enum class Reaction {
  n2p_o = 10,       ///< N2+ + O -> NO+ + N(2D)
  n2p_o_charge,     ///< N2+ + O -> O+ + N2
  n2p_o2,           ///< N2+ + O2 -> O2+ + N2
  n2p_no,           ///< N2+ + NO -> NO+ + N2
  op_n2,            ///< O+ + N2 -> NO+ + N
  op_o2,            ///< O+ + O2 -> O2+ + O
  op2d_n2,          ///< O+(2D) + N2 -> N2+ + O
  op2d_o2,          ///< O+(2D) + O2 -> O2+ + O
  op2d_o,           ///< O+(2D) + O -> O+ + O
  op2d_e,           ///< O+(2D) + e -> O+ + e
  op2p_n2,          ///< O+(2P) + N2 -> N2+ + O
  op2p_o2,          ///< O+(2P) + O2 -> O2+ + O
  op2p_o,           ///< O+(2P) + O -> O+(2D) + O
  op2p_e,           ///< O+(2P) + e -> O+(2D) + e
  np_o2,            ///< N+ + O2, all products
  np_o,             ///< N+ + O -> O+ + N
  np_no,            ///< N+ + NO -> NO+ + N
  o2p_no,           ///< O2+ + NO -> NO+ + O2
  o2p_n,            ///< O2+ + N -> NO+ + O
  n2p_e = 30,       ///< N2+ + e
  o2p_e_cold,       ///< O2+ + e below 1200 K
  o2p_e_hot,        ///< and above
  nop_e_cold,       ///< NO+ + e below 1200 K
  nop_e_hot,        ///< and above
  n2a_o = 40,       ///< N2(A) + O
  n2a_o2,           ///< N2(A) + O2
  n2a_light,        ///< s^-1
  o1s_of_n2a,       ///< O(1S) per N2(A) + O
  o1s_o2 = 50,      ///< O(1S) + O2
  o1s_o,            ///< O(1S) + O
  o1s_5577,         ///< s^-1
  o1s_2972,         ///< s^-1
  o1s_of_o2p,       ///< O(1S) per O2+ + e
  o1s_of_o2,        ///< O(1S) per 777.4 nm from O2
  o1s_of_o2p_n,     ///< O(1S) per O2+ + N
  o1s_of_np,        ///< O(1S) per N+ + O2
  o1d_n2 = 60,      ///< O(1D) + N2
  o1d_o2,           ///< O(1D) + O2
  o1d_o,            ///< O(1D) + O
  o1d_e,            ///< O(1D) + e
  o1d_6300,         ///< s^-1
  o1d_6364,         ///< s^-1
  o1d_of_o2p,       ///< O(1D) per O2+ + e
  o1d_of_n2d,       ///< O(1D) per N(2D) + O2
  o1d_of_np,        ///< O(1D) per N+ + O2
  o1d_of_o2,        ///< O(1D) per loss of 8.4 eV in O2
  n2d_o2 = 70,      ///< N(2D) + O2
  n2d_o,            ///< N(2D) + O
  n2d_no,           ///< N(2D) + NO
  n2d_e,            ///< N(2D) + e
  n2d_5200,         ///< s^-1
  n2d_of_n2p,       ///< N(2D) per N2+ + e
  n2d_of_nop,       ///< N(2D) per NO+ + e
  n2d_of_n2,        ///< N(2D) per N2 that an electron dissociates
  n2d_of_np,        ///< N(2D) per N+ of N2
  np_share = 80,    ///< N+ of all ions of N2
  op_share,         ///< O+ of all ions of O2
  np_to_nop,        ///< of N+ + O2
  np_to_o2p,        ///< of N+ + O2
  np_to_op,         ///< of N+ + O2
  op2p_light_4s,    ///< s^-1
  op2p_light_2d,    ///< s^-1
  light_3914 = 90,  ///< at 100 eV, 1e-18 cm^2
  light_4278,       ///< per 391.4 nm
  light_3371,       ///< per N2(C)
  light_6705,       ///< of all first positive light
  b_of_w,           ///< N2(B) per N2(W)
};

inline constexpr int kReactionNumbers = 100;

/// The rates of all rows at the temperatures of a place: cm^3 s^-1, or a row's value.
class RatesAtPlace {
 public:
  RatesAtPlace(const std::array<double, kReactionNumbers>& rates, bool hot) : rates_(rates), hot_(hot) {}
  double operator()(Reaction reaction) const { return rates_[static_cast<std::size_t>(reaction)]; }
  /// O2+ + e and NO+ + e, whose rows change at electrons of 1200 K.
  double o2p_e() const { return (*this)(hot_ ? Reaction::o2p_e_hot : Reaction::o2p_e_cold); }
  double nop_e() const { return (*this)(hot_ ? Reaction::nop_e_hot : Reaction::nop_e_cold); }

 private:
  std::array<double, kReactionNumbers> rates_;
  bool hot_;
};

class Reactions {
 public:
  /// Returns the reactions of the data file, which is read once.
  static const Reactions& standard();

  /// Returns the standard reactions with some rows replaced by those of a user's table of the same columns.
  /// Throws Error(unreadable_input) for a number that is none of them, a negative value, another `of`, a
  /// share above 1, or 0 for a loss without which a product would accumulate for ever.
  static Reactions changed(const std::string& csv, const std::string& name);

  /// Returns the reactions with the values of some rows times a factor above 0. A share stays at most 1, and
  /// the shares of N+ + O2 keep their sum.
  Reactions scaled(const std::map<int, double>& factor_of_number) const;

  RatesAtPlace at(double temperature_k, double electron_temperature_k) const;

  /// Returns the rate of one row with the air, cm^3 s^-1.
  double rate(Reaction reaction, double temperature_k) const;

  /// Returns the value of a row that does not depend on a temperature: a yield, a share, s^-1.
  double value(Reaction reaction) const;

 private:
  struct Row {
    double value = 0.0, exponent = 0.0, activation_k = 0.0;
    int of = 0;
  };
  void read(const std::string& csv, const std::string& name, bool may_add);
  std::map<int, Row> rows_;
};

}  // namespace vegard::sim
