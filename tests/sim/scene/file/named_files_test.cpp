// Files beside a scene, by all the keys that name one.
#include "sim/scene/file/named_files.h"

#include <gtest/gtest.h>

#include "sim/scene/table/parameter_table.h"

namespace vegard::sim::named_files_test {
namespace {

TEST(NamedFiles, AreThoseOfVolumesDepthAndComposite) {
  Scene scene;
  scene.footprints.resize(2);
  scene.footprints[0].name = "first";
  scene.footprints[0].image = "a.png";
  scene.footprints[1].name = "second";
  scene.footprints[1].energy_image = "b_{face}.png";
  scene.volumes.resize(1);
  scene.volumes[0].file = "c.vdb";
  scene.march.depth = "d.exr";
  scene.composite.background = "e.jpg";
  scene.sheets.resize(1);
  scene.sheets[0].profile_file = "f.csv";  // a table
  const std::vector<NamedFile> files = named_files(scene);
  std::vector<std::string> names;
  for (const NamedFile& file : files) {
    names.push_back(file.name);
    EXPECT_EQ(value_text(scene, resolve(scene, file.path).front()), "\"" + file.name + "\"");
  }
  EXPECT_EQ(names, (std::vector<std::string>{"a.png", "b_{face}.png", "c.vdb", "d.exr", "e.jpg"}));

  rename_files(scene, [](const std::string& name) { return "../" + name; });
  EXPECT_EQ(scene.footprints[1].energy_image, "../b_{face}.png");
  EXPECT_EQ(scene.volumes[0].file, "../c.vdb");
  EXPECT_EQ(scene.composite.foreground, "");
  EXPECT_EQ(scene.sheets[0].profile_file, "f.csv");
}

TEST(NamedFiles, OfACubeAreSix) {
  EXPECT_EQ(files_of_name("a.png"), std::vector<std::string>{"a.png"});
  EXPECT_EQ(files_of_name("x/b_{face}.png"),
            (std::vector<std::string>{"x/b_px.png", "x/b_nx.png", "x/b_py.png", "x/b_ny.png", "x/b_pz.png",
                                      "x/b_nz.png"}));
}

}  // namespace
}  // namespace vegard::sim::named_files_test
