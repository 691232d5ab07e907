// A made night as files: frames of two cameras, scenes and surveys for them, and what is true of each frame.
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "apps/options/command.h"
#include "sim/base/number/random.h"
#include "sim/base/utc_time.h"
#include "tests/recovery/made_night/night_picture.h"

namespace vegard::made_night {
namespace {

struct Options {
  std::uint64_t seed = 1;
  int frames = 2000, jobs = 2, sample = 30;
  std::string out;
};

void put(const std::string& file, const std::string& bytes) {
  std::filesystem::create_directories(std::filesystem::path(file).parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

/// The frame's file, broken as it is to be. False for one that is not there.
void put_frame(const Options& options, const NightFrame& frame, const std::string& jpeg) {
  const std::string file = options.out + "/" + frame.name;
  switch (frame.damage) {
    case Damage::none:
      return put(file, jpeg);
    case Damage::missing:
      return;
    case Damage::empty:
      return put(file, "");
    case Damage::cut:
      return put(file, jpeg.substr(0, jpeg.size() / 2));
    case Damage::junk:
      return put(file, "This is no picture.\n");
  }
}

std::string truth_row(const Night& night, const NightFrame& frame, const FrameTruth& truth) {
  constexpr const char* kDamage[] = {"", "missing", "empty", "cut", "junk"};
  const SkyState sky = night.sky(frame.utc_s);
  const double distance_km = sky.aurora == Aurora::none ? 0.0 : Night::distance_km(night.truth(frame));
  return fmt::format("{},{},{},{},{},{:d},{:d},{:d},{:d},{:d},{:d},{:.4f},{:.3f},{:.4f},{:.4f},{:.4f}\n",
                     frame.name, frame.camera == 0 ? "a" : "b", sim::utc_text(frame.utc_s),
                     kDamage[static_cast<int>(frame.damage)], truth.sky(), truth.arc, truth.twilight,
                     truth.cloud, truth.moon, truth.lamp, truth.aurora, truth.contrast, truth.cover,
                     sky.energy_kev, sky.flux_mw_m2, distance_km);
}

/// A survey of these lists, whose block is ten frames.
std::string survey_text(const std::string& name, const std::string& work, const std::string& list) {
  std::string text = fmt::format("[survey]\nname = \"{}\"\nwork = [{}]\nblock_frames = 10\n", name, work);
  for (const char* camera : {"a", "b"})
    text += fmt::format("[[camera]]\nname = \"{0}\"\nscene = \"{0}.toml\"\nframes = [\"{1}_{0}.txt\"]\n",
                        camera, list);
  return text;
}

int run(int argc, char** argv) {
  Options options;
  apps::Program program("made_night", "A made night: frames of two cameras, and what is true of them", {},
                        argc, argv);
  const apps::Command app = program.root();
  app.option("--seed", options.seed, "Of the night").shows_default();
  app.option("--frames", options.frames, "Of both cameras together").range(2, 1000000).shows_default();
  app.option("--sample", options.sample, "Rows of ten frames that fits.toml is of, drawn at random")
      .shows_default();
  app.option("--jobs", options.jobs, "Frames side by side").range(1, 256).shows_default();
  app.option("-o,--out", options.out, "Folder, which is to be new").required();
  if (const std::optional<int> end = program.read()) return *end;

  if (std::filesystem::exists(options.out)) throw std::runtime_error(options.out + " exists");
  const Night night(options.seed, options.frames);
  const std::vector<NightFrame>& frames = night.frames();
  std::vector<std::string> rows(frames.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < frames.size(); i = next++) {
      const NightPicture picture = night_picture(night, frames[i]);
      put_frame(options, frames[i], picture.jpeg);
      rows[i] = truth_row(night, frames[i], picture.truth);
    }
  };
  std::vector<std::thread> workers;
  for (int j = 0; j < options.jobs; ++j) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();

  std::string truth =
      "file,camera,time_utc,damage,sky,arc,twilight,cloud,moon,lamp,aurora,contrast,cover,energy_kev,flux_mw_"
      "m2,"
      "distance_km\n";
  std::string all[2], some[2];
  for (std::size_t i = 0; i < frames.size(); ++i) {
    truth += rows[i];
    all[frames[i].camera] += frames[i].name + "\n";
  }
  // Rows of ten, each drawn by itself.
  const int rows_of_ten = static_cast<int>(frames.size()) / 2 / 10;
  for (int s = 0; s < options.sample && rows_of_ten > 0; ++s) {
    const sim::Words words =
        sim::random_words(options.seed, sim::Stream::bootstrap, static_cast<std::uint32_t>(s), 77u, 0u);
    const int camera = s % 2, row = static_cast<int>(words[0] % static_cast<std::uint32_t>(rows_of_ten));
    for (const NightFrame& frame : frames)
      if (frame.camera == camera && frame.number / 10 == row) some[camera] += frame.name + "\n";
  }
  for (int camera = 0; camera < 2; ++camera) {
    const std::string name = camera == 0 ? "a" : "b";
    put(options.out + "/" + name + ".toml", Night::scene_text(camera));
    put(options.out + "/all_" + name + ".txt", all[camera]);
    put(options.out + "/some_" + name + ".txt", some[camera]);
  }
  put(options.out + "/filter.toml", survey_text("filter", "\"filter\"", "all"));
  put(options.out + "/fits.toml", survey_text("fits", "\"filter\", \"fit\"", "some"));
  put(options.out + "/truth.csv", truth);
  return 0;
}

}  // namespace
}  // namespace vegard::made_night

int main(int argc, char** argv) {
  try {
    return vegard::made_night::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "made_night: %s\n", error.what());
    return 1;
  }
}
