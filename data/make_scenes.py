#!/usr/bin/env python3
"""Writes the small scenes of known answer beside this file: cornell, sphere, furnace, cube (.gltf, self-contained).

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
        self.use(LIGHTS)
        self.doc["extensions"] = {LIGHTS: {"lights": [{"type": "point", "intensity": candela, "name": name}]}}
        self.node(name=name, translation=position, extensions={LIGHTS: {"light": 0}})

    def camera(self, name, position, yfov, turn=0.0):
        """Looks along -Z, turned left by `turn` radians."""
        cameras = self.doc.setdefault("cameras", [])
        cameras.append({"name": name, "type": "perspective", "perspective": {"yfov": yfov, "znear": 0.01}})
        rotation = [0, math.sin(turn / 2), 0, math.cos(turn / 2)]
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


def sphere(rings=48, segments=96):
    """A closed sphere of radius 1 m, albedo 0.5, 100 cd in the centre: E = 100 / (1 - 0.5) = 200 lx everywhere."""
    scene = Scene()
    material = scene.lambert("grey", (0.5, 0.5, 0.5))
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


if __name__ == "__main__":
    for write in (cornell, sphere, furnace, cube):
        write()
