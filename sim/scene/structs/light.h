// Lines, their blur and how points fall on the film: [[line]], [emission], [blur], [film].
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/base/number/vec3.h"

namespace vegard::sim {

/// Smallest scale height of a layer: the steps of altitude cannot resolve a thinner one.
inline constexpr double kThinnestLayer_km = 0.5;

/// [[line]]: a line that emission_lines() lacks, or has with other numbers. Its light comes from a column of
/// a sheet's profile file; else it is `ratio` times the photons of the line follows_nm; else it fills a layer
/// with its own height and thickness (sim/light/own_light.h).
struct OwnLine {
  std::string name = "line";
  double wavelength_nm = 486.1;
  double lifetime_s = 0.0;          ///< of the upper state, without collisions
  double follows_nm = 0.0;          ///< a line of the emission tables; 0: none
  double ratio = 1.0;               ///< photons for each photon of that line
  double rayleigh_per_mw_m2 = 0.0;  ///< brightness of its layer from straight below; 0: no layer
  double peak_km = 120.0;           ///< of its layer
  double scale_height_km = 0.0;     ///< of its layer; 0: that of the body's air
  std::string spectrum_file =
      {};  ///< CSV of a continuum, relative to the scene's file; empty: one wavelength
};

/// The texts of a folder of emission tables.
struct TableFolder {
  std::string place;                         ///< path of the folder, for messages
  std::map<std::string, std::string> files;  ///< text of each file by its name, "ver_maxwellian.csv"
};

/// How the light depends on the energy flux.
enum class FluxLaw {
  column,  ///< by the column brightnesses of the emission tables
  linear   ///< proportional
};

/// The emission tables of a scene that names none.
inline const char* const kDefaultEmissionTables = "vegard";

/// Limits of Emission::oxygen_factor, and of the factors that emission tables cover.
inline constexpr double kMinOxygenFactor = 0.1, kMaxOxygenFactor = 10.0;

/// Whether error bars contain the uncertainty of the emission tables.
enum class TablesUncertainty {
  modes,  ///< the coefficients of the tables' modes have mean 0 and standard deviation 1
  none    ///< the tables are exact
};

/// The delay between the electrons and the light that they excite.
enum class EmissionLag {
  lifetime,  ///< effective lifetimes of the excited atoms
  none       ///< no delay
};

struct Emission {
  std::vector<double> lines = {630.0, 557.7, 427.8};  ///< wavelengths in nm
  std::string tables = kDefaultEmissionTables;        ///< name of built-in tables, or a folder
  /// The text of that folder, read with the scene (sim/scene/table/emission_folder.h); null for built-in
  /// tables.
  std::shared_ptr<const TableFolder> folder;
  double oxygen_factor = 1.0;  ///< factor on the atomic oxygen of the tables' atmosphere
  /// Coefficients of the modes of the tables' uncertainty (sim/light/tables/light_modes.h), in standard
  /// deviations; those that are not there are 0.
  std::vector<double> modes;
  TablesUncertainty uncertainty = TablesUncertainty::modes;
  FluxLaw flux_law = FluxLaw::column;
  EmissionLag lag = EmissionLag::lifetime;
  /// Factors on the light, [line][altitude] with the altitudes of a HeightProfile; empty: all 1. No key of a
  /// scene file: sim/render/slab_exposer.h sets them to render a part of a scene.
  std::vector<std::shared_ptr<const std::vector<float>>> altitude_share;
};

enum class BlurKernelKind {
  full,  ///< untruncated
  paper  ///< truncated as in the paper
};

enum class BlurModel {
  angle,    ///< Gaussian with a width per line
  physical  ///< diffusion and drift of the excited atoms before they shine
};

enum class BlurOrder {
  lines,  ///< blurs each line separately, before the colours
  rgb     ///< blurs red, green and blue, as in the paper
};

/// The origin of the widths of BlurModel::angle.
enum class BlurWidths {
  given,  ///< Blur::width_deg
  paper   ///< 4.75 and 2.0 pixels of a picture of 383 rows over 35 degrees
};

struct Blur {
  std::vector<double> width_deg = {0.43, 0.18,
                                   0.0};  ///< standard deviation per line, in the order of Emission::lines
  BlurKernelKind kernel = BlurKernelKind::full;
  BlurModel model = BlurModel::angle;
  BlurOrder order = BlurOrder::lines;
  BlurWidths widths = BlurWidths::given;
  EastNorth wind_m_s{0.0, 0.0};  ///< of the air, which carries the excited atoms
};

enum class SplatRule {
  bilinear,
  nearest  ///< as in the paper
};

enum class PointWeight {
  rayleigh,
  unit  ///< every point has weight 1, as in the paper's forward mapping
};

struct Film {
  SplatRule splat = SplatRule::bilinear;
  PointWeight weight = PointWeight::rayleigh;
};

}  // namespace vegard::sim
