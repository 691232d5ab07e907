// What several pictures say together of the emission tables (fit/shared_physics.h), as files.
#pragma once

#include <string>
#include <vector>

#include "fit/shared_physics.h"

namespace vegard::fit {

/// Returns "used", "unknown", "contradicts".
const char* physics_use_name(PhysicsUse use);

/// What stands before a picture's numbers in the table: "frame,time_s" and "frame_1,2.5", for each picture.
struct NamesOfFrames {
  std::string head;
  std::vector<std::string> rows;
};

/// Returns a table with a row for each picture and number: the fit's own answer, and that with what the other
/// pictures say, its error whole and in parts.
std::string shared_physics_csv(const SharedPhysics& shared, const NamesOfFrames& names);

/// Returns all but the numbers: the test of the combination, of each picture, what is asked of the tables,
/// the means.
std::string shared_physics_json(const SharedPhysics& shared, const std::vector<std::string>& names);

/// Returns the sentences that say what the pictures ask of the tables; none if they say too little.
std::vector<std::string> asked_of_tables(const SharedPhysics& shared);

}  // namespace vegard::fit
