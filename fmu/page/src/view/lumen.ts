import { BufferGeometry, Float32BufferAttribute, Vector3 } from "three";
import type { Branch } from "../protocol";
import { MM } from "./shape";

/** Parts of a full circle. */
const AROUND = 40;

/** Rows of a round end. */
const CAP = 5;

/** A ball of the centreline, mm. */
interface Ball {
    centre: Vector3;
    radius: number;
}

/** A vertex of the wall and how far it lies inside another branch, mm. */
interface Vertex {
    place: Vector3;
    normal: Vector3;
    inside: number;
}

/** A branch with the box around it. */
interface Course {
    balls: Ball[];
    min: Vector3;
    max: Vector3;
}

/** The inside of branches: the union of the balls along their centrelines. */
export class Lumen {
    private readonly courses: Course[];

    constructor(branches: readonly Branch[]) {
        this.courses = branches.map((branch) => course(branch.balls)).filter((one) => one.balls.length > 1);
    }

    /** Its wall: tubes with round ends, cut along the lines where they enter one another, so that mouths are open. */
    wall(): BufferGeometry {
        const places: number[] = [];
        const normals: number[] = [];
        for (const course of this.courses) {
            const others = this.courses.filter((one) => one !== course && overlap(one, course));
            const rows = surface(thinned(course.balls), others);
            for (let row = 0; row + 1 < rows.length; row++) {
                for (let column = 0; column < AROUND; column++) {
                    const [a, b] = [rows[row]![column]!, rows[row]![column + 1]!];
                    const [c, d] = [rows[row + 1]![column + 1]!, rows[row + 1]![column]!];
                    for (const triangle of [
                        [a, b, d],
                        [b, c, d],
                    ]) {
                        const left = outside(triangle);
                        for (let k = 2; k < left.length; k++) {
                            for (const vertex of [left[0]!, left[k - 1]!, left[k]!]) {
                                places.push(vertex.place.x, vertex.place.y, vertex.place.z);
                                normals.push(vertex.normal.x, vertex.normal.y, vertex.normal.z);
                            }
                        }
                    }
                }
            }
        }
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", new Float32BufferAttribute(places, 3));
        geometry.setAttribute("normal", new Float32BufferAttribute(normals, 3));
        return geometry;
    }
}

function course(numbers: readonly number[]): Course {
    const balls: Ball[] = [];
    const [min, max] = [new Vector3().setScalar(Infinity), new Vector3().setScalar(-Infinity)];
    for (let k = 0; k + 3 < numbers.length; k += 4) {
        const centre = new Vector3(numbers[k], numbers[k + 1], numbers[k + 2]).multiplyScalar(MM);
        const radius = MM * numbers[k + 3]!;
        balls.push({ centre, radius });
        min.min(centre.clone().subScalar(radius));
        max.max(centre.clone().addScalar(radius));
    }
    return { balls, min, max };
}

function overlap(a: Course, b: Course): boolean {
    return (["x", "y", "z"] as const).every(
        (axis) => a.min[axis] <= b.max[axis] && b.min[axis] <= a.max[axis],
    );
}

/** Leaves out balls that are closer together than a wall of their radius shows. */
function thinned(balls: readonly Ball[]): Ball[] {
    const kept = [balls[0]!];
    for (const ball of balls.slice(1, -1)) {
        if (ball.centre.distanceTo(kept.at(-1)!.centre) > 0.3 * ball.radius) kept.push(ball);
    }
    return [...kept, balls.at(-1)!];
}

/** Rows of vertices around the centreline, with half a ball at each end. */
function surface(balls: readonly Ball[], others: readonly Course[]): Vertex[][] {
    const rows: Vertex[][] = [];
    const last = balls.length - 1;
    const tangent = (k: number) =>
        balls[Math.min(k + 1, last)]!.centre.clone()
            .sub(balls[Math.max(k - 1, 0)]!.centre)
            .normalize();
    const along = tangent(0);
    // Any direction across will do to begin with; it is then carried along without turning about the tangent.
    const across = new Vector3(Math.abs(along.x) < 0.9 ? 1 : 0, Math.abs(along.x) < 0.9 ? 0 : 1, 0);
    const row = (ball: Ball, lift: number) => {
        across.addScaledVector(along, -across.dot(along)).normalize();
        const third = along.clone().cross(across);
        const [cos, sin] = [Math.cos(lift), Math.sin(lift)];
        rows.push(
            Array.from({ length: AROUND + 1 }, (_, column) => {
                const angle = (2 * Math.PI * column) / AROUND;
                const normal = across.clone().multiplyScalar(cos * Math.cos(angle));
                normal.addScaledVector(third, cos * Math.sin(angle)).addScaledVector(along, sin);
                const place = ball.centre.clone().addScaledVector(normal, ball.radius);
                return { place, normal, inside: depth(place, others) };
            }),
        );
    };
    for (let k = -CAP; k < 0; k++) row(balls[0]!, (k * Math.PI) / 2 / CAP);
    balls.forEach((ball, k) => {
        along.copy(tangent(k));
        // Where a branch widens, its wall touches the balls behind their widest circle.
        const [before, after] = [balls[Math.max(k - 1, 0)]!, balls[Math.min(k + 1, last)]!];
        const slope = (after.radius - before.radius) / after.centre.distanceTo(before.centre);
        row(ball, -Math.asin(Math.max(-0.9, Math.min(0.9, slope))));
    });
    for (let k = 1; k <= CAP; k++) row(balls[last]!, (k * Math.PI) / 2 / CAP);
    return rows;
}

/** How far a place lies inside the nearest of other branches, mm; negative outside, and never less than what an edge spans. */
function depth(place: Vector3, others: readonly Course[]): number {
    let deepest = -10;
    const [way, from] = [new Vector3(), new Vector3()];
    for (const { balls, min, max } of others) {
        const { x, y, z } = place;
        if (x < min.x || x > max.x || y < min.y || y > max.y || z < min.z || z > max.z) continue;
        for (let k = 0; k + 1 < balls.length; k++) {
            const [a, b] = [balls[k]!, balls[k + 1]!];
            from.subVectors(place, a.centre);
            way.subVectors(b.centre, a.centre);
            const part = Math.max(0, Math.min(1, from.dot(way) / way.lengthSq()));
            const radius = a.radius + part * (b.radius - a.radius);
            deepest = Math.max(deepest, radius - from.addScaledVector(way, -part).length());
        }
    }
    return deepest;
}

/** The part of a triangle that lies in no other branch, as a polygon. */
function outside(triangle: readonly Vertex[]): Vertex[] {
    const polygon: Vertex[] = [];
    triangle.forEach((vertex, k) => {
        const next = triangle[(k + 1) % triangle.length]!;
        if (vertex.inside <= 0) polygon.push(vertex);
        if (vertex.inside > 0 === next.inside > 0) return;
        const part = vertex.inside / (vertex.inside - next.inside);
        polygon.push({
            place: vertex.place.clone().lerp(next.place, part),
            normal: vertex.normal.clone().lerp(next.normal, part).normalize(),
            inside: 0,
        });
    });
    return polygon;
}
