//! Textures whose pixels remain available for the export of a plot.

use egui::{ColorImage, Context, Id, TextureHandle, TextureId, TextureOptions};
use std::collections::HashMap;
use std::sync::{Arc, Weak};

/// Image on the screen, interpolated between its pixels.
pub struct Texture {
    handle: TextureHandle,
    image: Arc<ColorImage>,
}

/// Images of the textures on the screen.
pub(super) type Known = HashMap<TextureId, Weak<ColorImage>>;

fn with_known<T>(ctx: &Context, change: impl FnOnce(&mut Known) -> T) -> T {
    ctx.data_mut(|data| change(data.get_temp_mut_or_default(Id::unique("textures on the screen"))))
}

impl Texture {
    /// Creates a texture.
    pub fn new(ctx: &Context, name: &str, image: ColorImage) -> Self {
        let image = Arc::new(image);
        Self { handle: ctx.load_texture(name, Arc::clone(&image), TextureOptions::LINEAR), image }
    }

    /// Replaces the image of a texture, or creates it.
    pub fn put(place: &mut Option<Self>, ctx: &Context, name: &str, image: ColorImage) {
        match place {
            Some(texture) => {
                texture.image = Arc::new(image);
                texture.handle.set(Arc::clone(&texture.image), TextureOptions::LINEAR);
            }
            None => *place = Some(Self::new(ctx, name, image)),
        }
    }

    /// Returns the identity for painting. From now on an export of the screen can use its pixels.
    pub fn shown(&self, ctx: &Context) -> TextureId {
        with_known(ctx, |known| known.insert(self.handle.id(), Arc::downgrade(&self.image)));
        self.handle.id()
    }

    /// Returns the pixels.
    pub fn image(&self) -> &ColorImage {
        &self.image
    }
}

/// Returns the known images. Removes those that no longer exist.
pub(super) fn known(ctx: &Context) -> Known {
    with_known(ctx, |known| {
        known.retain(|_, image| image.strong_count() > 0);
        known.clone()
    })
}
