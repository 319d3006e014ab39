/** The mesh that comes with the page, for a scene whose vessel it is. */

import { STLLoader } from "three/examples/jsm/loaders/STLLoader.js";

/** Coordinates of a scene's mesh are in mm. */
const METRES = 1e-3;

/** Corners of the triangles of an STL file, nine numbers each, m. */
export function trianglesOf(stl: ArrayBuffer): number[] {
    const corners = new STLLoader().parse(stl).getAttribute("position").array;
    return Array.from(corners, (coordinate) => METRES * coordinate);
}
