// The forms of the preview's messages (frontend/serve/PREVIEW.md).

export type Vec3 = [number, number, number];

export interface Camera {
  rotation: Vec3;
  translation: Vec3;
  distance: number;
  fov: number;
  projection: 'perspective' | 'ortho';
}

export interface Section {
  /** Of unit length. */
  normal: Vec3;
  position: number;
  flipped: boolean;
}

export interface Look {
  width?: number;
  height?: number;
  camera?: Camera;
  moving?: boolean;
  section?: Section | null;
  shading?: 'studio' | 'flat';
  colorscheme?: string;
  axes?: boolean;
  edges?: boolean;
  time?: number;
}

export interface Position {
  line: number;
  character: number;
}

export interface Range {
  start: Position;
  end: Position;
}

export interface Place {
  uri: string;
  range: Range;
}

export interface Message {
  severity: 1 | 2 | 3 | 4;
  group: string;
  text: string;
  uri?: string;
  range?: Range;
}

export type Value = number | boolean | string | number[];

export interface Parameter {
  name: string;
  group: string;
  description: string;
  value: Value;
  default: Value;
  kind: 'number' | 'boolean' | 'text' | 'vector';
  choices?: { value: number | string; label: string }[];
  min?: number;
  max?: number;
  step?: number;
  length?: number;
}

export interface Box {
  min: Vec3;
  max: Vec3;
}

export interface Design {
  version: number;
  ok: boolean;
  camera?: Camera;
  bounds: Box | null;
  plane: boolean;
  animated: boolean;
  messages: Message[];
  parameters: Parameter[];
  sets: string[];
  set: string;
}

export interface Frame {
  preview: number;
  number: number;
  version: number;
  width: number;
  height: number;
  final: boolean;
  camera: Camera;
  ms: number;
  type: string;
}

export interface Pick {
  position: Vec3;
  normal: Vec3;
  flat: boolean;
  leaf: string;
  color: [number, number, number, number];
  feature?: { kind: 'vertex' | 'edge' | 'center'; points: Vec3[] };
  radius?: number;
  length?: number;
  places: (Place & { label: string })[];
}

export interface Insets {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** The requests of a client: their parameters, and what is answered. */
export interface Requests {
  'scadray/openPreview': [{ textDocument: { uri: string }; look: Look }, { preview: number; design?: Design }];
  'scadray/closePreview': [{ preview: number }, null];
  'scadray/viewAll': [{ preview: number; camera: Camera; insets?: Insets }, { camera: Camera }];
  'scadray/pick': [{ preview: number; camera: Camera; x: number; y: number; snap?: number }, Pick | null];
  'scadray/savePicture': [{ preview: number; path: string }, { path: string }];
  'scadray/exportModel': [{ preview: number; path: string }, { path: string }];
  'scadray/parameterSet': [
    { preview: number; action: 'choose' | 'save' | 'erase'; name: string },
    { problem: string },
  ];
  'scadray/source': [{ preview: number; uri: string }, { text: string } | null];
}

/** The notifications of a client. */
export interface Notifications {
  'scadray/look': { preview: number; look: Look };
  'scadray/cursor': { preview: number; uri?: string; position?: Position };
  'scadray/parameters': { preview: number; values: Record<string, Value | null> };
  'scadray/shown': { preview: number; number: number };
  'scadray/stop': { preview: number };
}
