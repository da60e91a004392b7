// SPDX-License-Identifier: Apache-2.0
// The pieces of an operating room's furniture, modelled with their usual sizes.
//
// Frames: y is up and 0 on the ground. The front of a piece faces +z. Pieces that hang on a wall
// have the wall at z = 0; those that hang from the ceiling take the room's height. The operating
// table and what belongs to it have the frame of the room: the middle of the table is above the
// origin, its long side along x, its head at -x.
#pragma once

#include "furniture/model.h"

namespace theatron::furniture {

// Height of the pad's upper side, and the table's length and width.
inline constexpr double table_top_m = 0.92, table_length_m = 2.0, table_width_m = 0.52;
// The two lamps above the table: the middle of each one's bright side.
inline constexpr Vec3 lamp_places[] = {{-0.42, 2.08, 0.34}, {0.46, 2.14, -0.36}};
inline constexpr Vec3 lamp_target{0, table_top_m, 0};
inline constexpr double lamp_radius_m = 0.32;

// table.cpp
Model operating_table();
Model instrument_stand();  // with a tray, over the table's foot
Model instrument_table();  // with a green drape
Model stool();
Model step();

// lamps.cpp
Model table_lamps(double room_height);     // both, with their arms
Model supply_unit(double room_height);     // shelves that hang from the ceiling
Model ceiling_panel(double room_height);   // laminar flow, above the table
Model ceiling_lights(double room_height);  // eight around that panel
Model hanging_monitor(double room_height);

// machines.cpp
Model anaesthesia_machine();
Model electrosurgery_cart();
Model infusion_stand();
Model suction_unit();
Model ultrasound_cart();

// cabinets.cpp
Model glass_cabinet();
Model drawer_cabinet();
Model waste_bin(Material lid);
Model linen_trolley();

// wall.cpp
Model double_door();
Model wall_monitor();
Model light_box();  // for X-ray films, without one
Model scrub_sink();
Model dispenser();    // of hand disinfectant
Model wall_clock();   // without hands
Model socket_rail();  // sockets and gas outlets
Model air_grille();
Model door_panel();  // switches beside the door
Model exit_sign();

// A clock's hand that points up, around the origin; the clock's face is at z = 0.
Model clock_hand(double length_m, double width_m);
inline constexpr double clock_height_m = 2.60, clock_depth_m = 0.045;

}  // namespace theatron::furniture
