//! Places of the panels that the palette finds. Choosing one scrolls to it and draws a ring around it.

/// Place of a panel.
pub struct Place {
    /// Name in the palette.
    pub name: &'static str,
    /// Keywords for the search.
    pub keywords: &'static str,
    /// Accessible name of the heading or control.
    pub control: &'static str,
}

/// All places, in the order of the panels.
pub const PLACES: [Place; 9] = [
    Place {
        name: "Load, speed and radius",
        keywords: "Hertz Hertzian pressure force bearing gear cam Moes M L E’ modulus viscosity",
        control: "Load number M",
    },
    Place {
        name: "Sliding",
        keywords: "SRR slide-to-roll ratio friction traction slip rolling",
        control: "Slide-to-roll ratio SRR",
    },
    Place {
        name: "Two bodies: materials, radii, speeds",
        keywords: "bearing gear cam ring ball roller steel ceramic glass rpm",
        control: "Two bodies",
    },
    Place {
        name: "Surfaces: roughness, film ratio, mixed lubrication",
        keywords: "rough roughness surface finish Rq Ra Sq Sa lambda film ratio asperities asperity boundary friction \
                   Stribeck Greenwood Tripp Patir Cheng Peklenik hardness ground honed superfinished",
        control: "Surfaces",
    },
    Place {
        name: "Lubricant",
        keywords: "oil grease base viscosity grade ISO VG pressure coefficient alpha temperature 40 °C 100 °C",
        control: "Lubricant",
    },
    Place {
        name: "Cavitation and oil supply",
        keywords: "starvation starved inlet film thickness supply meniscus grease JFO Elrod Adams penalty \
                   complementarity mass-conserving",
        control: "Cavitation",
    },
    Place {
        name: "Limiting shear stress",
        keywords: "friction traction Eyring yield slip Bair Winer",
        control: "Limiting shear stress",
    },
    Place { name: "Heat", keywords: "temperature thermal hot flash conductivity inlet TEHL", control: "Heat" },
    Place {
        name: "Reduced model in use",
        keywords: "modes size sampled equations deformation operator hyper-reduction",
        control: "Model",
    },
];
