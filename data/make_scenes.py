#!/usr/bin/env python3
"""Writes the small scenes beside this file (.gltf, self-contained): cornell, sphere, furnace and cube of known answer, the
rooms of light paths glossy_floor, metal_sculpture and glass_sphere, and bad_reflections with its matte twin.

Standard library only, and deterministic: running it again gives the same bytes. The outputs are committed.
"""
import base64
import json
import math
import pathlib
import struct

HERE = pathlib.Path(__file__).resolve().parent
LIGHTS = "KHR_lights_punctual"
STRENGTH = "KHR_materials_emissive_strength"
SPECULAR = "KHR_materials_specular"
TRANSMISSION = "KHR_materials_transmission"
VOLUME = "KHR_materials_volume"
IOR = "KHR_materials_ior"


class Scene:
    """A glTF document under construction; every mesh gets its own node."""

    def __init__(self):
        self.bytes = bytearray()
        self.doc = {"asset": {"version": "2.0", "generator": "Lumenwalk data/make_scenes.py"}, "scene": 0,
                    "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [], "accessors": [],
                    "bufferViews": [], "extensionsUsed": []}

    def use(self, extension):
        if extension not in self.doc["extensionsUsed"]:
            self.doc["extensionsUsed"].append(extension)

    def node(self, **fields):
        self.doc["scenes"][0]["nodes"].append(len(self.doc["nodes"]))
        self.doc["nodes"].append(fields)

    def lambert(self, name, color, emission=0.0, double_sided=True):
        """An exactly diffuse material: no metal and no specular lobe."""
        self.use(SPECULAR)
        material = {"name": name, "doubleSided": double_sided, "extensions": {SPECULAR: {"specularFactor": 0}},
                    "pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0}}
        if emission:
            self.use(STRENGTH)
            material["emissiveFactor"] = [1, 1, 1]
            material["extensions"][STRENGTH] = {"emissiveStrength": emission}
        self.doc["materials"].append(material)
        return len(self.doc["materials"]) - 1

    def glossy(self, name, color, roughness, metallic=0.0):
        """A dielectric or metal with the specular lobe of the specification."""
        self.doc["materials"].append({"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": [*color, 1], "metallicFactor": metallic, "roughnessFactor": roughness}})
        return len(self.doc["materials"]) - 1

    def glass(self, name, color=(1, 1, 1), thickness=0.0, ior=1.5, attenuation=None, distance=1.0):
        """Smooth glass: a thin sheet, or a solid when it has a thickness (m)."""
        self.use(TRANSMISSION)
        extensions = {TRANSMISSION: {"transmissionFactor": 1}}
        if ior != 1.5:
            self.use(IOR)
            extensions[IOR] = {"ior": ior}
        if thickness:
            self.use(VOLUME)
            extensions[VOLUME] = {"thicknessFactor": thickness}
            if attenuation:
                extensions[VOLUME].update({"attenuationColor": attenuation, "attenuationDistance": distance})
        self.doc["materials"].append({"name": name, "doubleSided": True, "extensions": extensions,
                                      "pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0,
                                                               "roughnessFactor": 0}})
        return len(self.doc["materials"]) - 1

    def accessor(self, rows, kind, code, component):
        flat = [value for row in rows for value in row]
        self.doc["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": 4 * len(flat)})
        self.bytes += struct.pack(f"<{len(flat)}{code}", *flat)
        accessor = {"bufferView": len(self.doc["bufferViews"]) - 1, "componentType": component, "type": kind,
                    "count": len(flat) if kind == "SCALAR" else len(rows)}
        if kind == "VEC3":
            stored = [struct.unpack("<3f", struct.pack("<3f", *row)) for row in rows]
            accessor["min"] = [min(row[i] for row in stored) for i in range(3)]
            accessor["max"] = [max(row[i] for row in stored) for i in range(3)]
        self.doc["accessors"].append(accessor)
        return len(self.doc["accessors"]) - 1

    def mesh(self, name, material, positions, normals, triangles):
        primitive = {"material": material,
                     "attributes": {"POSITION": self.accessor(positions, "VEC3", "f", 5126),
                                    "NORMAL": self.accessor(normals, "VEC3", "f", 5126)},
                     "indices": self.accessor(triangles, "SCALAR", "I", 5125)}
        self.doc["meshes"].append({"name": name, "primitives": [primitive]})
        self.node(name=name, mesh=len(self.doc["meshes"]) - 1)

    def quads(self, name, material, quads):
        """Each quad: four corners, counter-clockwise seen from its front."""
        positions, normals, triangles = [], [], []
        for quad in quads:
            first = len(positions)
            positions += quad
            normals += [normal_of(quad)] * 4
            triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
        self.mesh(name, material, positions, normals, triangles)

    def point_light(self, name, candela, position):
        self.light({"type": "point", "intensity": candela, "name": name}, translation=position)

    def light(self, light, **place):
        self.use(LIGHTS)
        lights = self.doc.setdefault("extensions", {}).setdefault(LIGHTS, {"lights": []})["lights"]
        lights.append(light)
        self.node(name=light["name"], **place, extensions={LIGHTS: {"light": len(lights) - 1}})

    def spot_down(self, name, candela, position, inner, outer):
        """A spot that shines along -Y."""
        self.light({"type": "spot", "intensity": candela, "name": name,
                    "spot": {"innerConeAngle": inner, "outerConeAngle": outer}},
                   translation=position, rotation=[-math.sqrt(0.5), 0, 0, math.sqrt(0.5)])

    def camera(self, name, position, yfov, turn=0.0, pitch=0.0):
        """Looks along -Z, raised by `pitch`, then turned left by `turn` radians."""
        cameras = self.doc.setdefault("cameras", [])
        cameras.append({"name": name, "type": "perspective", "perspective": {"yfov": yfov, "znear": 0.01}})
        (st, ct), (sp, cp) = [(math.sin(a / 2), math.cos(a / 2)) for a in (turn, pitch)]
        rotation = [ct * sp, st * cp, -st * sp, ct * cp] if pitch else [0, st, 0, ct]
        self.node(name=name, camera=len(cameras) - 1, translation=position, rotation=rotation)

    def save(self, name):
        data = base64.b64encode(bytes(self.bytes)).decode()
        self.doc["buffers"] = [{"byteLength": len(self.bytes), "uri": "data:application/octet-stream;base64," + data}]
        (HERE / name).write_text(json.dumps(self.doc, indent=1) + "\n")


def normal_of(quad):
    a, b, c = quad[:3]
    u, v = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
    n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    length = math.sqrt(sum(x * x for x in n))
    return tuple(x / length for x in n)


def box_faces(low, high):
    """The six sides of a box facing outwards, by name."""
    (a, b, c), (d, e, f) = low, high
    return {"left": [(a, b, c), (a, b, f), (a, e, f), (a, e, c)], "right": [(d, b, f), (d, b, c), (d, e, c), (d, e, f)],
            "floor": [(a, b, c), (d, b, c), (d, b, f), (a, b, f)], "ceiling": [(a, e, f), (d, e, f), (d, e, c), (a, e, c)],
            "back": [(d, b, c), (a, b, c), (a, e, c), (d, e, c)], "front": [(a, b, f), (d, b, f), (d, e, f), (a, e, f)]}


def inwards(quad):
    return quad[::-1]


def turned(quad, angle, x, z):
    c, s = math.cos(angle), math.sin(angle)
    return [(x + c * p[0] + s * p[2], p[1], z - s * p[0] + c * p[2]) for p in quad]


def cornell():
    """A room of 2 m open to the front, red left, green right, two blocks, a ceiling lamp of 1000 cd/m2."""
    scene = Scene()
    white = scene.lambert("white", (0.73, 0.73, 0.73))
    red = scene.lambert("red", (0.63, 0.06, 0.05))
    green = scene.lambert("green", (0.14, 0.45, 0.09))
    lamp = scene.lambert("lamp", (0, 0, 0), emission=1000, double_sided=False)
    room = {side: inwards(quad) for side, quad in box_faces((-1, 0, -1), (1, 2, 1)).items()}
    for side, material in [("floor", white), ("ceiling", white), ("back", white), ("left", red), ("right", green)]:
        scene.quads(side, material, [room[side]])
    for name, height, angle, x, z in [("tall_block", 1.2, 0.3, -0.35, -0.3), ("short_block", 0.6, -0.3, 0.35, 0.35)]:
        faces = box_faces((-0.3, 0, -0.3), (0.3, height, 0.3))
        sides = [turned(faces[side], angle, x, z) for side in ("left", "right", "ceiling", "back", "front")]
        scene.quads(name, white, sides)
    scene.quads("ceiling_lamp", lamp, [[(-0.25, 1.99, -0.25), (0.25, 1.99, -0.25), (0.25, 1.99, 0.25), (-0.25, 1.99, 0.25)]])
    scene.camera("front", [0, 1, 3.9], math.radians(39.3))
    scene.save("cornell.gltf")


def unit_sphere(rings, segments):
    """Points of a sphere of radius 1 and its triangles, fronts inwards."""
    points = [(0.0, 1.0, 0.0)]
    for i in range(1, rings):
        theta = math.pi * i / rings
        for j in range(segments):
            phi = 2 * math.pi * j / segments
            points.append((math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi)))
    points.append((0.0, -1.0, 0.0))
    at = lambda i, j: 1 + (i - 1) * segments + j % segments
    triangles = []
    for j in range(segments):
        triangles.append((0, at(1, j), at(1, j + 1)))
        for i in range(1, rings - 1):
            triangles += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
        triangles.append((at(rings - 1, j), len(points) - 1, at(rings - 1, j + 1)))
    return points, triangles


def sphere():
    """A closed sphere of radius 1 m, albedo 0.5, 100 cd in the centre: E = 100 / (1 - 0.5) = 200 lx everywhere."""
    scene = Scene()
    material = scene.lambert("grey", (0.5, 0.5, 0.5))
    points, triangles = unit_sphere(48, 96)
    scene.mesh("sphere", material, points, [tuple(-x for x in p) for p in points], triangles)
    scene.point_light("centre", 100, [0, 0, 0])
    scene.camera("inside", [0, 0, 0.5], 1.0)
    scene.save("sphere.gltf")


def furnace():
    """A closed box of 2 m whose walls emit 1 cd/m2 and reflect half: every radiance in it is 1 / (1 - 0.5) = 2 cd/m2."""
    scene = Scene()
    material = scene.lambert("glowing", (0.5, 0.5, 0.5), emission=1, double_sided=False)
    scene.quads("walls", material, [inwards(quad) for quad in box_faces((-1, -1, -1), (1, 1, 1)).values()])
    scene.camera("inside", [0.2, 0.1, 0.6], 1.2)
    scene.save("furnace.gltf")


def cube():
    """CIE 171:2006 case 5.8: a cube of 4 m, albedo 0.5 everywhere, 100 cd in the centre; E_indirect = flux/S x 0.5/0.5."""
    scene = Scene()
    material = scene.lambert("grey", (0.5, 0.5, 0.5))
    for side, quad in box_faces((-2, -2, -2), (2, 2, 2)).items():
        scene.quads(side, material, [inwards(quad)])
    scene.point_light("lamp", 100, [0, 0, 0])
    scene.camera("inside", [1.2, 0, 1.6], 1.2, turn=0.5)
    scene.save("cube.gltf")


def ball(scene, name, material, centre, radius, rings=32, segments=64):
    points, triangles = unit_sphere(rings, segments)
    placed = [tuple(c + radius * x for c, x in zip(centre, p)) for p in points]
    scene.mesh(name, material, placed, points, [t[::-1] for t in triangles])


def torus(scene, name, material, centre, large, small, turns=64, sides=32):
    """A ring in the plane of X and Y."""
    points, normals, triangles = [], [], []
    for i in range(turns):
        a = 2 * math.pi * i / turns
        for j in range(sides):
            b = 2 * math.pi * j / sides
            n = (math.cos(a) * math.cos(b), math.sin(a) * math.cos(b), math.sin(b))
            points.append((centre[0] + large * math.cos(a) + small * n[0], centre[1] + large * math.sin(a) + small * n[1],
                           centre[2] + small * n[2]))
            normals.append(n)
            k = lambda u, v: (u % turns) * sides + v % sides
            triangles += [(k(i, j), k(i + 1, j), k(i + 1, j + 1)), (k(i, j), k(i + 1, j + 1), k(i, j + 1))]
    scene.mesh(name, material, points, normals, triangles)


def room(scene, low, high, floor, walls, left=None, right=None):
    """Six inward sides, one node each."""
    materials = {"floor": floor, "left": left, "right": right}
    for side, quad in box_faces(low, high).items():
        chosen = materials.get(side)
        scene.quads(side, walls if chosen is None else chosen, [inwards(quad)])


def panel(scene, name, material, x, y, z, width, depth):
    """A horizontal rectangle that faces down."""
    a, b, c, d = x - width / 2, x + width / 2, z - depth / 2, z + depth / 2
    scene.quads(name, material, [[(a, y, c), (b, y, c), (b, y, d), (a, y, d)]])


def glossy_floor():
    """A closed room of 4 x 2.6 x 4 m with a polished floor (roughness 0.2), lit by a panel and a bulb."""
    scene = Scene()
    white, red = scene.lambert("white", (0.7, 0.7, 0.7)), scene.lambert("red", (0.6, 0.1, 0.08))
    blue, floor = scene.lambert("blue", (0.1, 0.2, 0.5)), scene.glossy("polished", (0.25, 0.18, 0.12), 0.2)
    lamp = scene.lambert("glow", (0, 0, 0), emission=4000, double_sided=False)
    room(scene, (-2, 0, -2), (2, 2.6, 2), floor, white, left=red, right=blue)
    sides = [turned(q, 0.5, 0.5, -0.9) for q in box_faces((-0.35, 0, -0.35), (0.35, 1.0, 0.35)).values()]
    scene.quads("block", white, sides)
    panel(scene, "panel", lamp, -0.6, 2.59, -0.6, 0.6, 0.6)
    scene.point_light("bulb", 60, [1.2, 1.7, -1.2])
    scene.camera("front", [0, 1.4, 1.9], 0.9, pitch=-0.3)
    scene.save("glossy_floor.gltf")


def metal_sculpture():
    """A closed room of 3 x 2.4 x 3 m with a rough gold ring (roughness 0.3) and a mirror ball, under a panel and a spot."""
    scene = Scene()
    white, grey = scene.lambert("white", (0.7, 0.7, 0.7)), scene.lambert("grey", (0.4, 0.4, 0.42))
    gold, chrome = scene.glossy("gold", (1.0, 0.77, 0.34), 0.3, 1.0), scene.glossy("chrome", (0.9, 0.9, 0.9), 0.0, 1.0)
    green = scene.lambert("green", (0.14, 0.45, 0.09))
    lamp = scene.lambert("glow", (0, 0, 0), emission=5000, double_sided=False)
    room(scene, (-1.5, 0, -1.5), (1.5, 2.4, 1.5), grey, white, left=green)
    scene.quads("plinth", white, [q for s, q in box_faces((-0.3, 0, -0.55), (0.3, 0.5, -0.05)).items()])
    torus(scene, "ring", gold, (0, 0.95, -0.3), 0.32, 0.12)
    ball(scene, "mirror_ball", chrome, (0.75, 0.3, 0.1), 0.3)
    panel(scene, "panel", lamp, -0.5, 2.39, 0.2, 0.5, 0.5)
    scene.spot_down("spot", 300, [0.6, 2.3, -0.2], 0.25, 0.4)
    scene.camera("front", [-0.2, 1.2, 1.45], 0.9, pitch=-0.2)
    scene.save("metal_sculpture.gltf")


def glass_sphere():
    """A closed room of 2 x 2 x 2 m with a solid ball of faintly green glass that focuses a spot on the floor, and a tinted
    sheet that a bulb shines through."""
    scene = Scene()
    white, red = scene.lambert("white", (0.7, 0.7, 0.7)), scene.lambert("red", (0.6, 0.1, 0.08))
    solid = scene.glass("solid", thickness=0.5, attenuation=[0.7, 0.95, 0.75], distance=0.5)
    sheet = scene.glass("sheet", color=(0.9, 0.6, 0.3))
    lamp = scene.lambert("glow", (0, 0, 0), emission=1000, double_sided=False)
    room(scene, (-1, 0, -1), (1, 2, 1), white, white, left=red)
    ball(scene, "glass_ball", solid, (0, 0.45, 0), 0.25, rings=48, segments=96)
    scene.quads("sheet", sheet, [[(0.45, 0.2, -0.8), (0.45, 0.2, 0.2), (0.45, 1.3, 0.2), (0.45, 1.3, -0.8)]])
    panel(scene, "panel", lamp, -0.5, 1.99, 0.4, 0.3, 0.3)
    scene.spot_down("spot", 200, [0, 1.95, 0], 0.2, 0.25)
    scene.point_light("bulb", 15, [0.8, 0.8, -0.4])
    scene.camera("front", [-0.1, 1.1, 0.97], 1.0, pitch=-0.5)
    scene.save("glass_sphere.gltf")


def bad_reflections(matte):
    """An office of 5 x 2.8 x 4 m: the window and the picture on the far wall mirror one desk lamp each. The twin is matte."""
    scene = Scene()
    white, dark = scene.lambert("white", (0.6, 0.6, 0.6)), scene.lambert("night", (0.03, 0.03, 0.04))
    grey, wood = scene.lambert("grey", (0.3, 0.3, 0.3)), scene.lambert("wood", (0.3, 0.2, 0.12))
    window = scene.lambert("pane", (0.03, 0.03, 0.04)) if matte else scene.glass("pane")
    picture = scene.lambert("print", (0.2, 0.25, 0.2)) if matte else scene.glossy("print", (0.2, 0.25, 0.2), 0.05)
    ceiling = scene.lambert("ceiling_glow", (0, 0, 0), emission=1500, double_sided=False)
    desk_1, desk_2 = [scene.lambert(f"glow_{i}", (0, 0, 0), emission=60000, double_sided=False) for i in (1, 2)]
    room(scene, (-2.5, 0, -2), (2.5, 2.8, 2), grey, white)
    upright = lambda x, y, z, w, h: [(x - w / 2, y - h / 2, z), (x + w / 2, y - h / 2, z), (x + w / 2, y + h / 2, z),
                                     (x - w / 2, y + h / 2, z)]
    scene.quads("night", dark, [upright(-0.75, 1.4, -1.99, 1.0, 1.2)])
    scene.quads("window", window, [upright(-0.75, 1.4, -1.95, 1.0, 1.2)])
    scene.quads("picture", picture, [upright(0.55, 1.4, -1.98, 0.7, 0.6)])
    scene.quads("table", wood, list(box_faces((-1.2, 0.7, 0.2), (1.2, 0.74, 0.9)).values()))
    panel(scene, "ceiling", ceiling, 0, 2.79, -0.3, 0.6, 0.6)
    scene.quads("desk_1", desk_1, [upright(1.0, 1.6, 1.9, 0.16, 0.1)[::-1]])
    scene.quads("desk_2", desk_2, [upright(-1.4, 1.5, 1.8, 0.16, 0.1)[::-1]])
    scene.camera("desk", [0, 1.2, 1.5], 0.9)
    scene.save("bad_reflections_matte.gltf" if matte else "bad_reflections.gltf")


if __name__ == "__main__":
    bad_reflections(False)
    bad_reflections(True)
    for write in (cornell, sphere, furnace, cube, glossy_floor, metal_sculpture, glass_sphere):
        write()
