// Small tables to begin with, a letter before each as fuzz_tables.cpp reads it.
#include "tests/fuzz/target.h"
#include "tests/support/fits_bytes.h"

namespace vegard::tests {
namespace {

/// solve-field's table of stars, of whole numbers.
std::string solved_field_of(int rows) {
  std::string cards = fits_card("XTENSION", "'BINTABLE'");
  const std::pair<const char*, std::string> keys[] = {{"BITPIX", "8"},    {"NAXIS", "2"},
                                                      {"NAXIS1", "16"},   {"NAXIS2", std::to_string(rows)},
                                                      {"PCOUNT", "0"},    {"GCOUNT", "1"},
                                                      {"TFIELDS", "4"},   {"TTYPE1", "'field_x'"},
                                                      {"TFORM1", "'1J'"}, {"TTYPE2", "'field_y'"},
                                                      {"TFORM2", "'1J'"}, {"TTYPE3", "'index_ra'"},
                                                      {"TFORM3", "'1J'"}, {"TTYPE4", "'index_dec'"},
                                                      {"TFORM4", "'1J'"}};
  for (const auto& [key, value] : keys) cards += fits_card(key, value);
  std::vector<double> numbers;
  for (int row = 0; row < rows; ++row)
    for (const int number : {11 + row, 21, 279, 38}) numbers.push_back(number);
  return fits_header(8, {}) + fits_block(cards + "END", ' ') + fits_block(fits_numbers(32, numbers), '\0');
}

/// Of precipitation, two cells by two.
std::string small_map() {
  std::string axes;
  for (const auto& [number, name] : {std::pair{"1", "'EAST'"}, {"2", "'NORTH'"}}) {
    axes += fits_card(std::string("CTYPE") + number, name) + fits_card(std::string("CUNIT") + number, "'km'");
    for (const auto& [key, value] : {std::pair{"CRPIX", "1.0"}, {"CRVAL", "150.0"}, {"CDELT", "2.0"}})
      axes += fits_card(std::string(key) + number, value);
  }
  return fits_header(-32, {2, 2, 2}, axes + fits_card("SITELAT", "67.0") + fits_card("SITELONG", "20.0")) +
         fits_block(fits_numbers(-32, {1.0, 2.0, 0.0, 3.5, 2.0, 3.0, 0.0, 4.5}), '\0');
}

/// solve-field's header.
std::string small_solution() {
  std::string cards = fits_card("CTYPE1", "'RA---TAN-SIP'") + fits_card("CTYPE2", "'DEC--TAN-SIP'");
  for (const auto& [key, value] : {std::pair{"CRVAL1", "279.2"},
                                   {"CRVAL2", "38.8"},
                                   {"CRPIX1", "2.0"},
                                   {"CRPIX2", "1.5"},
                                   {"CD1_1", "-0.5"},
                                   {"CD1_2", "0.01"},
                                   {"CD2_1", "0.02"},
                                   {"CD2_2", "-0.5"},
                                   {"IMAGEW", "3"},
                                   {"IMAGEH", "2"},
                                   {"A_ORDER", "2"},
                                   {"A_0_2", "1e-4"},
                                   {"A_2_0", "-2e-4"},
                                   {"B_ORDER", "2"},
                                   {"B_1_1", "3e-5"}})
    cards += fits_card(key, value);
  return fits_header(8, {}, cards);
}

constexpr const char* kSurvey =
    "n[survey]\nname = \"a\"\nwork = [\"border\", \"fit\"]\nscene = \"a.toml\"\nblock_frames = "
    "5\n[survey.cost_s]\nfit = 2.5\n"
    "[[camera]]\nname = \"b\"\nframes = [\"c\"]\nset = [\"fit.bands=5\"]\ndecoding = "
    "\"gamma:2.2\"\nchannel = \"red\"\n"
    "[[camera.calibration]]\nfrom = \"2019-03-01\"\nfile = \"d.toml\"\nmask = \"e.png\"\n[[skip]]\ncamera "
    "= \"b\"\nreason "
    "= \"fog\"\n";

constexpr const char* kCounts =
    "xname = \"a\"\ndark_counts = 3.5\ngain_e_per_count = 2\n[[filter]]\nname = \"g\"\nline_nm = "
    "557.7\nwidth_nm = "
    "2.0\nwidth_error = 0.03\nrayleigh_per_count_s = 24.2\nrayleigh_per_count_s_error = 1\n[[filter]]\nname "
    "= "
    "\"b\"\nline_nm = 427.8\nflat = \"f.fits\"\nchannel = \"blue\"\n";

constexpr const char* kPlan =
    "o{\"kind\": \"vegard survey plan\", \"format\": 1, \"version\": \"0\", \"name\": \"a\", \"folder\": "
    "\".\", \"work\": "
    "[\"fit\"], \"cameras\": [{\"name\": \"b\", \"scene\": \"c\", \"set\": [], \"decoding\": \"\", "
    "\"channel\": 1, "
    "\"calibrations\": [{\"from_s\": null, \"until_s\": 1.5, \"file\": \"d\", \"mask\": \"\"}]}], "
    "\"inputs\": [{\"what\": "
    "\"e\", \"sha256\": \"00\"}], \"shards\": 2, \"blocks\": [{\"camera\": 0, \"calibration\": -1, "
    "\"seconds\": 2.5, "
    "\"frames\": [[\"a#1\", 0.25, \"fog\"]]}, {\"camera\": 0, \"calibration\": 0, \"seconds\": 2, "
    "\"frames\": [[\"b\", 1e9]]}]}";

}  // namespace

std::vector<std::string> fuzz_seeds(const std::string&) {
  return {
      "a# a remark\nname,other one\n1,2\n+3.5e-3 , -4\r\n",
      "baltitude_km,557.7,630.0,ver_4278\n90,0,0,0\n110,5.5,1,2\n250,0,3e0,1\n",
      "cwavelength_nm,red,green,blue\n400,0,0.1,1\n500,0.1,1,0.5\n600,1,0.5,0\n700,0.5,0,0\n",
      "dlinear,encoded\n0,0\n0.2,0.5\n1,1\n",
      "egrey,red,green,blue\n0,0,0,0\n0.5,1,0.5,0\n1,1,1,1\n",
      "fname,azimuth_deg,zenith_deg,x_px,y_px,magnitude\nstar 0,0,8,33,25.1,1.5\n\"a, b\",77,14,36.5,23.8,\n",
      "fstar,x_px,y_px\nVega,1,2\nalf Aql,3,4\nHIP 91262,5,6\n",
      "fx_px,y_px,ra_deg,dec_deg\n1,2,279.2,38.8\n",
      "fx_px,y_px,ra_hours,dec_deg\n1,2,18.6,-38.8\n",
      "f" + solved_field_of(2),
      "g# when, and of what\nframe_1.png 0\nframe_2.png 2.5\n\nfolder/frame_3.png\n",
      "hfile,time\na.png,2015-10-07T08:23:51.743Z\nb.png,2015-10-07 08:24:00\n",
      "ha.png,1.5\nfolder/b.png,-2e3\n",
      "i# made\n[site]\nlatitude_deg = 65.0\naltitude_m = 100.0\ntime_utc = "
      "\"2020-01-01T20:00:00Z\"\n[camera]\n"
      "model = \"equidistant\"\nwidth = 64\nheight = 48\nfocal_px = 15.0\nprincipal_x_px = 1.0\n"
      "azimuth_deg = 0.0\nelevation_deg = 90.0\n",
      "j" +
          [] {
            std::string all = "# 125 numbers\n";
            for (int i = 0; i < 125; ++i) all += i % 5 == 4 ? "0.01\n" : "1e-2, ";
            return all;
          }(),
      "k2015-10-07T08:23:51.743Z",
      "kPKR_DASC_0558_20151007_082351.743.FITS",
      "k+05:30",
      "lcurtain,point,east_km,north_km,energy_flux_mw_m2,energy_kev,width_km,energy_kev_error\n"
      "1,1,-60,300,1,2,2,nan\n1,2,60,300,1.5,2,2,\n2,1,0,200,3,4,1,0.1\n2,2,9,201,4,3,1,0.1\n",
      "m" + small_map(),
      kSurvey,
      kCounts,
      kPlan,
      "p# when\nnight.pgm.gz#1 2019-03-01T22:10:03.5Z\nb c.png 2019-03-01 22:10\na/20190301_221001.png\r\n",
      "u  3 330 37 2456946.5 2457250.5 3 -1.0 1.01 -15.5 33.4 -9.1 -0.02 0.04 0.32 0\n% more\n 1 0 0 0 0 12 "
      "1 1 0 "
      "0 0 0 0 -0.5 0\n",
      "v" + small_solution(),
      "yname,camera,x_px,y_px,sigma_px\nknot,1,465.5,354.3,1\nknot,b.toml,358.2,680.5,\nray,1,3,4,2\nray,1,5,"
      "6,2\n"
      "ray,2,7,8,2\nray,2,9,8,2\n",
      "zTimestamp,Latitude,Longitude,Radius\n2014-03-10 06:05:33,66.2,-0.5,6838137\n",
      "zut1_unix,glat,glon,gdalt\n1394431533.5,66.2,359.5,460\n",
      "{DELTA 1 DEB\n1 06251U 62025E   06176.82412014  .00008885  00000-0  12808-3 0  3985\n"
      "2 06251  58.0579  54.0425 0030035 139.1568 221.1854 15.56387291  6774\n",
      "|{\"kind\": \"vegard invert\", \"spectrum\": \"maxwellian\", \"tables\": \"vegard\", \"solutions\": "
      "[{\"energy_kev\": {\"value\": 3, \"sigma_ln\": 0.1, \"free\": true}, \"energy_flux_mw_m2\": "
      "{\"value\": 5, \"sigma_ln\": 0.2}, \"correlations\": {\"energy_kev,energy_flux_mw_m2\": -0.5}}]}",
      "}time_s,altitude_km,density_m3,density_m3_error\n0,90,1e11,1e9\n0,95,2e11,1e9\n0,100,3e11,1e9\n"
      "0,105,3e11,1e9\n0,110,2e11,1e9\n",
      "w# a profile\n# decoding: srgb\nband,row_px,r,\"g, h\"\n0,0,1,2\n0,1,,4\n1,0,5e-3,6\n1,1,7,8\n",
      "qaltitude_km,T_K,nN2,nO2,nO\n90,190,4e13,1e13,2e11\n110,240,2e12,3e11,2e11\n400,1000,4e6,1e5,1e8\n",
      "tnumber,value,exponent,activation_K,of\n43,0.19,0,0,0\n31,1.9e-7,-0.7,0,2\n",
      "soxygen_factor,E0_keV,altitude_km,ver_5577\n0.5,1,80,0\n0.5,1,640,2\n0.5,9,80,3\n0.5,9,640,1\n1,1,80,"
      "0\n1,1,640,1\n"
      "1,9,80,3\n1,9,640,1\n",
      "sQ_erg,E0_keV,R_5577\n0.1,1,20\n0.1,10,22\n1,1,120\n1,10,110\n10,1,1100\n10,10,1000\n",
      "saltitude_km,T_K,nO,nO2,nN2\n80,200,2e9,6e13,2e14\n640,900,1e6,1e2,1e4\n",
      "r{\"kind\": \"vegard sky kinds\", \"format\": 2, \"questions\": {\"arc\": {\"grey\": {\"constant\": "
      "0, "
      "\"terms\": []}, \"colour\": {\"constant\": 1, \"terms\": [{\"feature\": \"contrast\", \"weight\": 2, "
      "\"least\": 0, \"most\": 1, \"missing\": 0}]}, \"line\": {\"slope\": 1, \"offset\": 0}, "
      "\"line_with_trees\": {\"slope\": 1, \"offset\": 0}, \"trees\": [[{\"feature\": "
      "\"green\", \"threshold\": 0.2, \"missing\": \"below\", \"below\": 1, \"above\": 2}, {\"score\": -1}, "
      "{\"score\": 1}]]}}}",
  };
}

std::vector<std::string> fuzz_dictionary() {
  std::vector<std::string> words = {"\n",
                                    ",",
                                    "#",
                                    "\"",
                                    "\xef\xbb\xbf",
                                    "\r\n",
                                    "nan",
                                    "inf",
                                    "1e308",
                                    "1e-320",
                                    "-0",
                                    "+",
                                    "x_px",
                                    "y_px",
                                    "ra_deg",
                                    "dec_deg",
                                    "star",
                                    "magnitude",
                                    "Vega",
                                    "HIP 1",
                                    "HD 1",
                                    "name",
                                    "azimuth_deg",
                                    "grey",
                                    "linear",
                                    "encoded",
                                    "altitude_km",
                                    "557.7",
                                    "file,time",
                                    "a.png",
                                    "[camera]\n",
                                    "[site]\n",
                                    "hfov_deg = ",
                                    "focal_px = ",
                                    "model = ",
                                    "lens_k1 = ",
                                    "roll_deg = ",
                                    "9999-12-31T23:59:60Z",
                                    "0001-01-01",
                                    ".99999999999999999999"};
  for (const char* key : {"BITPIX", "NAXIS1", "NAXIS2", "PCOUNT", "TFIELDS", "TFORM1", "THEAP", "TSCAL1"})
    for (const char* value : {"0", "-1", "999", "'1D'", "'1PE(9)'", "'0J'", "1E308", "2147483647"})
      words.push_back(fits_card(key, value));
  return words;
}

void mend_after_mutation(std::string&) {}

}  // namespace vegard::tests
