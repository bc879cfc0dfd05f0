// What a session keeps in files: ambiances and bookmarks beside the scene, recorded walks in the output folder. Nothing
// throws: what goes wrong is told to the user.
#pragma once
#include "app/session/session.h"

namespace lw {

/// A session with the ambiances, groups and bookmarks kept beside the scene. A file that is damaged is told of and
/// never overwritten.
Session open_session(const World& world, std::filesystem::path output);

/// Keeps ambiances, groups and photometric files beside the scene; tells that `what` is saved, or why not.
void save_presets(Session& session, const std::string& what);

/// Puts a photometric file (relative to the scene's folder) on a point or spot lamp, or takes it off (""); keeps that
/// beside the scene and asks for the scene to be loaded anew. Tells what is wrong with a file.
void attach_file(Session& session, size_t lamp, const std::string& file);

/// Keeps the view as a bookmark beside the scene.
void add_bookmark(Session& session);

/// Starts recording the walk, or ends and saves it.
void toggle_recording(Session& session);

/// A file in the output folder that does not exist yet: SCENE-001.EXT, SCENE-002.EXT, ...
std::filesystem::path free_name(const Session& session, const std::string& extension);

}  // namespace lw
