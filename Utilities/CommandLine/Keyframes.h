// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Keyframes.h
 * @brief What the camera and the sun of a scene are at a moment of its animation.
 */
#ifndef Keyframes_h
#define Keyframes_h

#include "Scene.h"

namespace nephoscope::program
{
/**
 * The scene with the camera and the sun of a moment.
 *
 * Each key goes its own way through the keyframes that give it: from one to the next with a steady speed ("linear"), or along a
 * cubic whose slope at a keyframe is that between its neighbours and which rests at both ends ("smooth"). Before the first and
 * after the last it stays. A direction toward the sun keeps unit length.
 * @param moment 0 at the first frame, 1 at the last
 */
Scene sceneAt(const Scene& scene, double moment);
}
#endif
