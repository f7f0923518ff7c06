// Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
// The viewer inside report.html: blocks as built, moved by the frames of an animation. It reads the element
// <script id="motion" type="application/json"> that libs/report writes (see libs/report/ViewerData.h) and requests
// nothing from anywhere.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const freeColour = new THREE.Color(0xc9805a);
const fixedColour = new THREE.Color(0xb4b4ad);
const chosenColour = new THREE.Color(0xf2d024);

// Quantities that blocks can be coloured by: a number of each block in each frame; and their units.
const quantities = {
    none: () => 0,
    displacement: (frame, block) => length3(frame.displacement, block),
    rotation: (frame, block) => length3(frame.rotation, block),
};

const least = 1e-300; // where nothing has moved, nothing is divided by zero
const units = { displacement: "m", rotation: "rad" };

function length3(values, block) {
    return Math.hypot(values[3 * block], values[3 * block + 1], values[3 * block + 2]);
}

// Blue, white, red over 0 to 1.
function colourOf(share) {
    return share < 0.5
        ? new THREE.Color(0x3b6fb6).lerp(new THREE.Color(0xf2f2f2), 2 * share)
        : new THREE.Color(0xf2f2f2).lerp(new THREE.Color(0xc0392b), 2 * share - 1);
}

// What the colours mean: from 0 to the largest value of all frames.
function showScale(scale, quantity, largest) {
    scale.hidden = quantity === "none";
    if (!scale.hidden) {
        const colours = [0, 0.5, 1].map((share) => `#${colourOf(share).getHexString()}`);
        scale.innerHTML = `0 <span style="display:inline-block;width:8em;height:1em;vertical-align:middle;` +
            `background:linear-gradient(to right,${colours.join(",")})"></span> `;
        scale.append(`${largest > least ? largest.toPrecision(3) : 0} ${units[quantity]}`);
    }
}

// The faces of a block as triangles about its mass centre, each with its own corners, so that faces are shaded flat.
function geometryOf(block) {
    const positions = [];
    const edges = [];
    const corner = (index) => new THREE.Vector3().fromArray(block.vertices, 3 * index);
    for (const face of block.faces) {
        const corners = face.map(corner);
        const normal = new THREE.Vector3();
        corners.forEach((at, i) => normal.add(new THREE.Vector3().crossVectors(at, corners[(i + 1) % corners.length])));
        normal.normalize();
        const first = new THREE.Vector3().subVectors(corners[1], corners[0]).normalize();
        const second = new THREE.Vector3().crossVectors(normal, first);
        const flat = corners.map((at) => new THREE.Vector2(at.dot(first), at.dot(second)));
        for (const triangle of THREE.ShapeUtils.triangulateShape(flat, [])) {
            for (const i of triangle) {
                positions.push(...corners[i].toArray());
            }
        }
        corners.forEach((at, i) => edges.push(...at.toArray(), ...corners[(i + 1) % corners.length].toArray()));
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
    geometry.computeVertexNormals();
    const lines = new THREE.BufferGeometry();
    lines.setAttribute("position", new THREE.Float32BufferAttribute(edges, 3));
    return { geometry, lines };
}

function show(motion, element) {
    const canvas = element.querySelector("canvas");
    const control = (name) => element.querySelector(`[name=${name}]`);
    const readout = element.querySelector(".readout");
    const scale = element.querySelector(".scale");
    const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    const scene = new THREE.Scene();
    scene.background = new THREE.Color(0xffffff);
    scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8a80, 2.2));
    const sun = new THREE.DirectionalLight(0xffffff, 1.6);
    scene.add(sun);

    const blocks = motion.blocks.map((block, index) => {
        const { geometry, lines } = geometryOf(block);
        const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ polygonOffset: true, polygonOffsetFactor: 1,
            polygonOffsetUnits: 1 }));
        mesh.add(new THREE.LineSegments(lines, new THREE.LineBasicMaterial({ color: 0x3a2a20 })));
        mesh.userData = { index, centre: new THREE.Vector3(...block.centre), fixed: block.fixed };
        scene.add(mesh);
        return mesh;
    });

    // The camera looks at the free blocks; a ground of any extent would make them small.
    const box = new THREE.Box3();
    blocks.filter((mesh) => !mesh.userData.fixed).forEach((mesh) => box.union(
        new THREE.Box3().setFromBufferAttribute(mesh.geometry.getAttribute("position")).translate(mesh.userData.centre)));
    if (box.isEmpty()) {
        box.setFromCenterAndSize(new THREE.Vector3(), new THREE.Vector3(1, 1, 1));
    }
    const size = box.getSize(new THREE.Vector3()).length();
    const middle = box.getCenter(new THREE.Vector3());
    const up = new THREE.Vector3(0, motion.dimensions === 2 ? 1 : 0, motion.dimensions === 2 ? 0 : 1);
    const camera = new THREE.PerspectiveCamera(35, 1, size / 1000, 100 * size);
    camera.up.copy(up);
    const from = motion.dimensions === 2 ? new THREE.Vector3(0.25, 0.25, 1.6) : new THREE.Vector3(-0.9, -1.3, 0.7);
    camera.position.copy(middle).addScaledVector(from, 1.1 * size);
    sun.position.copy(camera.position).addScaledVector(up, size);
    const orbit = new OrbitControls(camera, canvas);
    orbit.target.copy(middle);
    orbit.update();

    let chosen = -1;
    let playing = false;
    const frameIndex = () => Math.round(Number(control("frame").value));
    const largest = Object.fromEntries(Object.entries(quantities).map(([name, value]) => [name,
        Math.max(least, ...motion.frames.map((frame) => Math.max(0, ...blocks.map((mesh) =>
            mesh.userData.fixed ? 0 : value(frame, mesh.userData.index)))))]));

    function draw() {
        const frame = motion.frames[frameIndex()];
        const magnification = Number(control("magnification").value) || 0;
        const quantity = control("quantity").value;
        showScale(scale, quantity, largest[quantity]);
        for (const mesh of blocks) {
            const { index, centre, fixed } = mesh.userData;
            mesh.visible = frame.displacement[3 * index] !== null;
            mesh.position.fromArray(frame.displacement, 3 * index).multiplyScalar(magnification).add(centre);
            const rotation = new THREE.Vector3().fromArray(frame.rotation, 3 * index).multiplyScalar(magnification);
            const angle = rotation.length();
            mesh.quaternion.setFromAxisAngle(angle > 0 ? rotation.divideScalar(angle) : up, angle);
            mesh.material.color.copy(index === chosen ? chosenColour : fixed ? fixedColour
                : quantity === "none" ? freeColour
                : colourOf(quantities[quantity](frame, index) / largest[quantity]));
        }
        const time = `${motion.timeName} ${frame.time.toPrecision(4)}${motion.timeUnit}`;
        readout.textContent = chosen < 0 ? `${time}. Click a block for its displacement.`
            : `${time}. Block ${chosen}${blocks[chosen].userData.fixed ? " (fixed)" : ""}: displacement ` +
              `(${[0, 1, 2].map((i) => (frame.displacement[3 * chosen + i] ?? NaN).toPrecision(4)).join(" ")}) m, rotation ` +
              `${length3(frame.rotation, chosen).toPrecision(4)} rad`;
        renderer.render(scene, camera);
    }

    function resize() {
        const width = element.clientWidth;
        const height = Math.max(240, Math.min(560, 0.6 * width));
        renderer.setPixelRatio(window.devicePixelRatio);
        renderer.setSize(width, height);
        camera.aspect = width / height;
        camera.updateProjectionMatrix();
        draw();
    }

    function choose(event) {
        const bounds = canvas.getBoundingClientRect();
        const ray = new THREE.Raycaster();
        ray.setFromCamera(new THREE.Vector2(2 * (event.clientX - bounds.left) / bounds.width - 1,
            1 - 2 * (event.clientY - bounds.top) / bounds.height), camera);
        const [hit] = ray.intersectObjects(blocks, false);
        chosen = hit ? hit.object.userData.index : -1;
        draw();
    }

    function step(previous, now) {
        if (!playing) {
            return;
        }
        // The whole animation in four seconds.
        const position = Number(control("frame").value) + (now - previous) / 4000 * (motion.frames.length - 1);
        control("frame").value = position > motion.frames.length - 1 ? 0 : position;
        draw();
        requestAnimationFrame((next) => step(now, next));
    }

    control("frame").max = motion.frames.length - 1;
    control("frame").value = motion.frames.length - 1;
    control("magnification").value = motion.magnification;
    control("frame").addEventListener("input", draw);
    control("magnification").addEventListener("input", draw);
    control("quantity").addEventListener("input", draw);
    control("play").addEventListener("click", () => {
        playing = !playing;
        control("play").textContent = playing ? "Stop" : "Play";
        requestAnimationFrame((now) => step(now, now));
    });
    // A drag turns the view; only a click without one chooses.
    let pressed = null;
    canvas.addEventListener("pointerdown", (event) => { pressed = [event.clientX, event.clientY]; });
    canvas.addEventListener("pointerup", (event) => {
        if (pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 4) {
            choose(event);
        }
        pressed = null;
    });
    orbit.addEventListener("change", draw);
    window.addEventListener("resize", resize);
    element.dataset.ready = "yes";
    resize();
}

for (const element of document.querySelectorAll(".viewer")) {
    try {
        show(JSON.parse(document.getElementById(element.dataset.motion).textContent), element);
    } catch (fault) {
        element.querySelector(".readout").textContent = `The viewer needs WebGL: ${fault.message}`;
    }
}
