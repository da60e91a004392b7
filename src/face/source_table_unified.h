// SPDX-License-Identifier: Apache-2.0
// The table of VRCFaceTracking's Unified Expressions (version 2) and of the names that it derives
// from them, as avatars ask for one or the other. Names that feed no channel are left out.
#pragma once

#include "face/sources.h"

namespace theatron::face {

constexpr std::string_view unified_inputs[] = {"EyeSquintLeft",
                                               "EyeSquintRight",
                                               "EyeWideLeft",
                                               "EyeWideRight",
                                               "BrowLowererLeft",
                                               "BrowLowererRight",
                                               "BrowPinchLeft",
                                               "BrowPinchRight",
                                               "BrowInnerUpLeft",
                                               "BrowInnerUpRight",
                                               "BrowOuterUpLeft",
                                               "BrowOuterUpRight",
                                               "CheekSquintLeft",
                                               "CheekSquintRight",
                                               "CheekPuffLeft",
                                               "CheekPuffRight",
                                               "JawOpen",
                                               "JawRight",
                                               "JawLeft",
                                               "JawForward",
                                               "MouthClosed",
                                               "LipSuckUpperLeft",
                                               "LipSuckLowerLeft",
                                               "LipFunnelUpperLeft",
                                               "LipPuckerUpperLeft",
                                               "MouthUpperLeft",
                                               "LipFunnelLowerLeft",
                                               "LipPuckerLowerLeft",
                                               "MouthLowerLeft",
                                               "LipSuckUpperRight",
                                               "LipSuckLowerRight",
                                               "LipFunnelUpperRight",
                                               "LipPuckerUpperRight",
                                               "MouthUpperRight",
                                               "LipFunnelLowerRight",
                                               "LipPuckerLowerRight",
                                               "MouthLowerRight",
                                               "MouthUpperUpLeft",
                                               "MouthUpperUpRight",
                                               "NoseSneerLeft",
                                               "NoseSneerRight",
                                               "MouthLowerDownLeft",
                                               "MouthLowerDownRight",
                                               "MouthCornerPullLeft",
                                               "MouthCornerPullRight",
                                               "MouthFrownLeft",
                                               "MouthFrownRight",
                                               "MouthStretchLeft",
                                               "MouthStretchRight",
                                               "MouthDimpleLeft",
                                               "MouthDimpleRight",
                                               "MouthRaiserUpper",
                                               "MouthRaiserLower",
                                               "MouthPressLeft",
                                               "MouthPressRight",
                                               "MouthTightenerLeft",
                                               "MouthTightenerRight",
                                               "TongueOut",
                                               "EyeLidLeft",
                                               "EyeLidRight",
                                               "EyeLid",
                                               "EyeClosedLeft",
                                               "EyeClosedRight",
                                               "EyeClosed",
                                               "EyeOpenLeft",
                                               "EyeOpenRight",
                                               "EyeOpen",
                                               "EyesSquint",
                                               "EyeSquint",
                                               "EyeWide",
                                               "EyeLeftX",
                                               "EyeRightX",
                                               "EyeLeftY",
                                               "EyeY",
                                               "EyeRightY",
                                               "EyeX",
                                               "BrowDown",
                                               "BrowInnerUp",
                                               "BrowOuterUp",
                                               "BrowUp",
                                               "BrowExpression",
                                               "SmileFrown",
                                               "SmileSad",
                                               "CheekPuffSuck",
                                               "BrowExpressionLeft",
                                               "SmileFrownLeft",
                                               "SmileSadLeft",
                                               "CheekPuffSuckLeft",
                                               "BrowExpressionRight",
                                               "SmileFrownRight",
                                               "SmileSadRight",
                                               "CheekPuffSuckRight",
                                               "CheekSquint",
                                               "JawX",
                                               "JawZ",
                                               "LipFunnel",
                                               "LipFunnelUpper",
                                               "LipFunnelLower",
                                               "LipPucker",
                                               "LipPuckerLeft",
                                               "LipPuckerRight",
                                               "LipPuckerUpper",
                                               "LipPuckerLower",
                                               "LipSuck",
                                               "LipSuckUpper",
                                               "LipSuckLower",
                                               "MouthDimple",
                                               "MouthLowerDown",
                                               "MouthOpen",
                                               "MouthPress",
                                               "MouthStretch",
                                               "MouthUpperUp",
                                               "MouthX",
                                               "NoseSneer",
                                               "MouthTightener"};
constexpr Term unified_terms[] = {
    {0, eye_squint_left},                          // EyeSquintLeft
    {1, eye_squint_right},                         // EyeSquintRight
    {2, eye_wide_left},                            // EyeWideLeft
    {3, eye_wide_right},                           // EyeWideRight
    {4, brow_down_left},                           // BrowLowererLeft
    {5, brow_down_right},                          // BrowLowererRight
    {6, brow_down_left, Shape::plain, 0.5F},       // BrowPinchLeft
    {7, brow_down_right, Shape::plain, 0.5F},      // BrowPinchRight
    {8, brow_inner_up},                            // BrowInnerUpLeft
    {9, brow_inner_up},                            // BrowInnerUpRight
    {10, brow_outer_up_left},                      // BrowOuterUpLeft
    {11, brow_outer_up_right},                     // BrowOuterUpRight
    {12, cheek_squint_left},                       // CheekSquintLeft
    {13, cheek_squint_right},                      // CheekSquintRight
    {14, cheek_puff},                              // CheekPuffLeft
    {15, cheek_puff},                              // CheekPuffRight
    {16, jaw_open},                                // JawOpen
    {17, jaw_right},                               // JawRight
    {18, jaw_left},                                // JawLeft
    {19, jaw_forward},                             // JawForward
    {20, mouth_close},                             // MouthClosed
    {21, mouth_roll_upper},                        // LipSuckUpperLeft
    {22, mouth_roll_lower},                        // LipSuckLowerLeft
    {23, mouth_funnel},                            // LipFunnelUpperLeft
    {24, mouth_pucker},                            // LipPuckerUpperLeft
    {25, mouth_left},                              // MouthUpperLeft
    {26, mouth_funnel},                            // LipFunnelLowerLeft
    {27, mouth_pucker},                            // LipPuckerLowerLeft
    {28, mouth_left},                              // MouthLowerLeft
    {29, mouth_roll_upper},                        // LipSuckUpperRight
    {30, mouth_roll_lower},                        // LipSuckLowerRight
    {31, mouth_funnel},                            // LipFunnelUpperRight
    {32, mouth_pucker},                            // LipPuckerUpperRight
    {33, mouth_right},                             // MouthUpperRight
    {34, mouth_funnel},                            // LipFunnelLowerRight
    {35, mouth_pucker},                            // LipPuckerLowerRight
    {36, mouth_right},                             // MouthLowerRight
    {37, mouth_upper_up_left},                     // MouthUpperUpLeft
    {38, mouth_upper_up_right},                    // MouthUpperUpRight
    {39, nose_sneer_left},                         // NoseSneerLeft
    {40, nose_sneer_right},                        // NoseSneerRight
    {41, mouth_lower_down_left},                   // MouthLowerDownLeft
    {42, mouth_lower_down_right},                  // MouthLowerDownRight
    {43, mouth_smile_left},                        // MouthCornerPullLeft
    {44, mouth_smile_right},                       // MouthCornerPullRight
    {45, mouth_frown_left},                        // MouthFrownLeft
    {46, mouth_frown_right},                       // MouthFrownRight
    {47, mouth_stretch_left},                      // MouthStretchLeft
    {48, mouth_stretch_right},                     // MouthStretchRight
    {49, mouth_dimple_left},                       // MouthDimpleLeft
    {50, mouth_dimple_right},                      // MouthDimpleRight
    {51, mouth_shrug_upper},                       // MouthRaiserUpper
    {52, mouth_shrug_lower},                       // MouthRaiserLower
    {53, mouth_press_left},                        // MouthPressLeft
    {54, mouth_press_right},                       // MouthPressRight
    {55, mouth_press_left, Shape::plain, 0.5F},    // MouthTightenerLeft
    {56, mouth_press_right, Shape::plain, 0.5F},   // MouthTightenerRight
    {57, tongue_out},                              // TongueOut
    {58, eye_blink_left, Shape::lid_closed},       // EyeLidLeft
    {59, eye_blink_right, Shape::lid_closed},      // EyeLidRight
    {58, eye_wide_left, Shape::lid_wide},          // EyeLidLeft
    {59, eye_wide_right, Shape::lid_wide},         // EyeLidRight
    {60, eye_blink_left, Shape::lid_closed},       // EyeLid
    {60, eye_blink_right, Shape::lid_closed},      // EyeLid
    {60, eye_wide_left, Shape::lid_wide},          // EyeLid
    {60, eye_wide_right, Shape::lid_wide},         // EyeLid
    {61, eye_blink_left},                          // EyeClosedLeft
    {62, eye_blink_right},                         // EyeClosedRight
    {63, eye_blink_left},                          // EyeClosed
    {63, eye_blink_right},                         // EyeClosed
    {64, eye_blink_left, Shape::opening},          // EyeOpenLeft
    {65, eye_blink_right, Shape::opening},         // EyeOpenRight
    {66, eye_blink_left, Shape::opening},          // EyeOpen
    {66, eye_blink_right, Shape::opening},         // EyeOpen
    {67, eye_squint_left},                         // EyesSquint
    {67, eye_squint_right},                        // EyesSquint
    {68, eye_squint_left},                         // EyeSquint
    {68, eye_squint_right},                        // EyeSquint
    {69, eye_wide_left},                           // EyeWide
    {69, eye_wide_right},                          // EyeWide
    {70, eye_look_in_left, Shape::positive},       // EyeLeftX
    {70, eye_look_out_left, Shape::negative},      // EyeLeftX
    {71, eye_look_out_right, Shape::positive},     // EyeRightX
    {71, eye_look_in_right, Shape::negative},      // EyeRightX
    {72, eye_look_up_left, Shape::positive},       // EyeLeftY
    {72, eye_look_down_left, Shape::negative},     // EyeLeftY
    {73, eye_look_up_left, Shape::positive},       // EyeY
    {73, eye_look_down_left, Shape::negative},     // EyeY
    {74, eye_look_up_right, Shape::positive},      // EyeRightY
    {74, eye_look_down_right, Shape::negative},    // EyeRightY
    {73, eye_look_up_right, Shape::positive},      // EyeY
    {73, eye_look_down_right, Shape::negative},    // EyeY
    {75, eye_look_in_left, Shape::positive},       // EyeX
    {75, eye_look_out_left, Shape::negative},      // EyeX
    {75, eye_look_out_right, Shape::positive},     // EyeX
    {75, eye_look_in_right, Shape::negative},      // EyeX
    {76, brow_down_left},                          // BrowDown
    {76, brow_down_right},                         // BrowDown
    {77, brow_inner_up},                           // BrowInnerUp
    {78, brow_outer_up_left},                      // BrowOuterUp
    {78, brow_outer_up_right},                     // BrowOuterUp
    {79, brow_outer_up_left},                      // BrowUp
    {79, brow_outer_up_right},                     // BrowUp
    {79, brow_inner_up},                           // BrowUp
    {80, brow_outer_up_left, Shape::positive},     // BrowExpression
    {80, brow_down_left, Shape::negative},         // BrowExpression
    {81, mouth_smile_left, Shape::positive},       // SmileFrown
    {81, mouth_frown_left, Shape::negative},       // SmileFrown
    {82, mouth_smile_left, Shape::positive},       // SmileSad
    {82, mouth_frown_left, Shape::negative},       // SmileSad
    {80, brow_outer_up_right, Shape::positive},    // BrowExpression
    {80, brow_down_right, Shape::negative},        // BrowExpression
    {81, mouth_smile_right, Shape::positive},      // SmileFrown
    {81, mouth_frown_right, Shape::negative},      // SmileFrown
    {82, mouth_smile_right, Shape::positive},      // SmileSad
    {82, mouth_frown_right, Shape::negative},      // SmileSad
    {83, cheek_puff, Shape::positive},             // CheekPuffSuck
    {84, brow_outer_up_left, Shape::positive},     // BrowExpressionLeft
    {84, brow_down_left, Shape::negative},         // BrowExpressionLeft
    {85, mouth_smile_left, Shape::positive},       // SmileFrownLeft
    {85, mouth_frown_left, Shape::negative},       // SmileFrownLeft
    {86, mouth_smile_left, Shape::positive},       // SmileSadLeft
    {86, mouth_frown_left, Shape::negative},       // SmileSadLeft
    {87, cheek_puff, Shape::positive},             // CheekPuffSuckLeft
    {88, brow_outer_up_right, Shape::positive},    // BrowExpressionRight
    {88, brow_down_right, Shape::negative},        // BrowExpressionRight
    {89, mouth_smile_right, Shape::positive},      // SmileFrownRight
    {89, mouth_frown_right, Shape::negative},      // SmileFrownRight
    {90, mouth_smile_right, Shape::positive},      // SmileSadRight
    {90, mouth_frown_right, Shape::negative},      // SmileSadRight
    {91, cheek_puff, Shape::positive},             // CheekPuffSuckRight
    {92, cheek_squint_left},                       // CheekSquint
    {92, cheek_squint_right},                      // CheekSquint
    {93, jaw_right, Shape::positive},              // JawX
    {93, jaw_left, Shape::negative},               // JawX
    {94, jaw_forward, Shape::positive},            // JawZ
    {95, mouth_funnel},                            // LipFunnel
    {96, mouth_funnel},                            // LipFunnelUpper
    {97, mouth_funnel},                            // LipFunnelLower
    {98, mouth_pucker},                            // LipPucker
    {99, mouth_pucker},                            // LipPuckerLeft
    {100, mouth_pucker},                           // LipPuckerRight
    {101, mouth_pucker},                           // LipPuckerUpper
    {102, mouth_pucker},                           // LipPuckerLower
    {103, mouth_roll_upper},                       // LipSuck
    {103, mouth_roll_lower},                       // LipSuck
    {104, mouth_roll_upper},                       // LipSuckUpper
    {105, mouth_roll_lower},                       // LipSuckLower
    {106, mouth_dimple_left},                      // MouthDimple
    {106, mouth_dimple_right},                     // MouthDimple
    {107, mouth_lower_down_left},                  // MouthLowerDown
    {107, mouth_lower_down_right},                 // MouthLowerDown
    {108, jaw_open, Shape::plain, 0.5F},           // MouthOpen
    {109, mouth_press_left},                       // MouthPress
    {109, mouth_press_right},                      // MouthPress
    {110, mouth_stretch_left},                     // MouthStretch
    {110, mouth_stretch_right},                    // MouthStretch
    {111, mouth_upper_up_left},                    // MouthUpperUp
    {111, mouth_upper_up_right},                   // MouthUpperUp
    {112, mouth_right, Shape::positive},           // MouthX
    {112, mouth_left, Shape::negative},            // MouthX
    {113, nose_sneer_left},                        // NoseSneer
    {113, nose_sneer_right},                       // NoseSneer
    {114, mouth_press_left, Shape::plain, 0.5F},   // MouthTightener
    {114, mouth_press_right, Shape::plain, 0.5F},  // MouthTightener
};

}  // namespace theatron::face
